# SPDX-License-Identifier: GPL-2.0-or-later
"""Coulomb's line against closed forms and against its own coverage."""

import math
import statistics
from pathlib import Path

import numpy as np
import pytest
from shearbox_tools.analysis.strength import fit_line, known_scatter
from shearbox_tools.asking.models import find_model, model_files
from shearbox_tools.asking.request import Request

from paper_tools.record import read_record

SIGMA = np.array([100.0, 200, 300, 400])


def test_exact_line() -> None:
    line = fit_line(SIGMA, 12 + SIGMA * np.tan(np.radians(31)), np.full(4, 2.0))
    assert line.c_kPa == pytest.approx(12)
    assert line.phi_deg == pytest.approx(31)
    assert line.r_squared == pytest.approx(1)


@pytest.mark.filterwarnings("error")
def test_peaks_without_errors_have_a_line() -> None:
    """Of stresses that are all the same there is nothing that a line could explain."""
    line = fit_line(SIGMA, 12 + SIGMA / 2, np.zeros(4))
    assert (line.c_kPa, line.slope) == pytest.approx((12, 0.5))
    assert np.isnan(fit_line(SIGMA, np.zeros(4), np.zeros(4)).r_squared)


def test_half_widths_of_equal_weights_are_the_textbook_ones() -> None:
    tau = np.array([58.0, 104, 166, 209])
    line = fit_line(SIGMA, tau, np.ones(4))
    slope, intercept = np.polyfit(SIGMA, tau, 1)
    s2 = np.sum((tau - slope * SIGMA - intercept) ** 2) / 2
    spread = np.sum((SIGMA - 250) ** 2)
    assert line.c_half_width_kPa == pytest.approx(4.302653 * np.sqrt(s2 * (1 / 4 + 250**2 / spread)), rel=1e-6)
    error = 4.302653 * np.sqrt(s2 / spread) / (1 + slope**2)
    assert line.phi_half_width_deg == pytest.approx(np.degrees(error), rel=1e-6)
    assert line.band(np.array([0.0]))[0] == pytest.approx(line.c_half_width_kPa)


def test_errors_of_the_peaks_are_never_shrunk() -> None:
    line = fit_line(SIGMA, 0.5 * SIGMA, np.full(4, 3.0))
    assert line.chi2_reduced == pytest.approx(0, abs=1e-12)
    spread = np.sum((SIGMA - 250) ** 2)
    expected = np.degrees(4.302653 * 3 / np.sqrt(spread) / 1.25)
    assert line.phi_half_width_deg == pytest.approx(expected, rel=1e-6)


def test_two_points_have_propagated_errors_only() -> None:
    line = fit_line(SIGMA[:2], np.array([50.0, 100.0]), np.array([3.0, 4.0]))
    assert line.chi2_reduced is None
    expected = np.degrees(1.959964 * 5 / 100 / 1.25)
    assert line.phi_half_width_deg == pytest.approx(expected, rel=1e-6)


def test_interval_holds_the_truth_in_95_of_100() -> None:
    rng = np.random.default_rng(7)
    hits = 0
    for _ in range(1000):
        line = fit_line(SIGMA, 0.5 * SIGMA + rng.normal(size=4) * 8, np.full(4, 1.0))
        hits += abs(line.c_kPa) < line.c_half_width_kPa
    assert 930 <= hits <= 970


@pytest.mark.parametrize("model", sorted(path.stem for path in model_files()))
def test_the_known_scatter_is_that_of_the_study(model: str) -> None:
    """Of the models with four specimens and more whose φ can be told."""
    study = read_record(Path(__file__).resolve().parents[2] / "examples" / "paper" / "measured")
    kind, _, sizes, discs, _ = model.replace("Type", "").split("_")
    entry = f"{kind}_{sizes}" + "_triple" * (discs == "3-circle")
    phi = [known for one in study["smooth"][entry] if math.isfinite(known := one.mean("phi"))]
    said = (
        f"{len(phi)} packings of this model, with the parameters of the decks, had φ from {min(phi):.0f} to {max(phi):.0f}°"
        if len(phi) > 3
        else "not known"
    )
    identity = Request(find_model(model), (100.0,)).identity({})
    assert said in known_scatter(identity)
    assert len(phi) < 4 or f"standard deviation {statistics.stdev(phi):.1f}°" in known_scatter(identity)
    assert "not known" in known_scatter(identity | {"model dmin": 0.001})  # another model of that name
