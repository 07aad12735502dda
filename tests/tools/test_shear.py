# SPDX-License-Identifier: GPL-2.0-or-later
"""What is said of the shear phase at one stress, on curves with known answers."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from synthetic import GRAINS, correlated_noise, curves

from shearbox_tools.analysis.motion import full_speed
from shearbox_tools.analysis.shear import Shear, analyse
from shearbox_tools.reading.readers import Columns

BED = {"grains": GRAINS, "height_m": 0.0987, "solid_fraction": 0.835}
S = curves(200, 8)["displacement_mm"]


def sheared(data: Columns, complete: bool = True, speed: float = 2, bed: dict[str, float] | None = None) -> Shear:
    """At 200 kPa; speed in mm/s."""
    identity: dict[str, Any] = {"speed_mm_s": speed, "model width": 0.1, "parameters": {"density": "2650"}}
    bed = BED if bed is None else bed
    return analyse(200, Path("."), data, full_speed(data), complete, identity, bed, 0, 0.0)


def noise(rows: int, deviation: float, seed: int = 1) -> np.ndarray:
    return correlated_noise(np.random.default_rng(seed), rows, deviation, 8)


def with_stress(tau: np.ndarray, travel: float = 8) -> Columns:
    """The same on both halves."""
    return {**curves(200, travel), "tau_kPa": tau, "tau_upper_kPa": tau}


def test_a_test_without_a_fault_has_no_remarks() -> None:
    shear = sheared(curves(200, 8))
    assert shear.remarks == [] and shear.doubt is None
    assert {name: verdict.holds for name, verdict in shear.verdicts.items()} == {
        "dilates": True,
        "peak_at_steepest_dilatancy": True,
        "quasi_static": True,
    }


@pytest.mark.parametrize("spike", [1000, -1000])
def test_spikes_at_start_and_stop_do_not_count(spike: float) -> None:
    """Nine rows of a ramp and forty after the stop, which have any stress: all numbers are those without them."""
    clean = curves(200, 8)
    moving = {name: column[9:760] for name, column in clean.items()}
    with_ends = {name: column.copy() for name, column in clean.items()}
    for name in ("tau_kPa", "tau_upper_kPa"):
        with_ends[name][:9] = with_ends[name][760:] = spike
    with_ends["displacement_mm"][:9] = S[9] - 0.001 * np.cumsum(np.arange(9, 0, -1))[::-1]  # slower than 0.01 a row
    with_ends["displacement_mm"][760:] = S[759] + 0.004
    one, other = sheared(with_ends), sheared(moving)
    assert (one.peak, one.smoothed, one.residual, one.ultimate) == (
        other.peak,
        other.smoothed,
        other.residual,
        other.ultimate,
    )
    assert one.inertia == other.inertia


def test_an_unfinished_test_judges_no_feature() -> None:
    shear = sheared({name: column[:13] for name, column in curves(200, 8).items()}, complete=False)
    assert shear.doubt == "sheared to 0.12 mm only"
    assert shear.verdicts["dilates"].holds is None
    assert shear.verdicts["peak_at_steepest_dilatancy"].holds is None
    assert "sheared to 0.12 mm only" in shear.remarks


@pytest.mark.parametrize("deviation, part", [(150, "too uncertain (error ≤ 25 %)"), (1, "0.1 % of the width (≥ 1 %)")])
def test_a_travel_of_a_tenth_of_a_millimetre_is_no_test(deviation: float, part: str) -> None:
    """Whether its peak is lost in the noise or not."""
    data = curves(200, 0.1)
    top = 80 - 20000 * (data["displacement_mm"] - 0.05) ** 2
    shear = sheared(with_stress(top + noise(800, deviation), 0.1))
    assert shear.doubt is not None and part in shear.doubt
    assert shear.verdicts["dilates"].holds is None
    assert any("the peak cannot be judged" in remark for remark in shear.remarks)


@pytest.mark.parametrize("travel, doubted", [(4.9, True), (5.1, False)])
def test_a_stress_that_still_rises_is_doubted_if_the_travel_is_short(travel: float, doubted: bool) -> None:
    data = curves(200, travel)
    data["tau_kPa"] = 12 * data["displacement_mm"] + noise(800, 1)
    shear = sheared(data)
    assert shear.peak.at_boundary
    assert (shear.doubt is not None) == doubted
    if doubted:
        assert "% of the width without a peak (≥ 5 %)" in str(shear.doubt)


def test_a_peak_that_the_polynomial_misses_is_said() -> None:
    """350 kPa for 1.4 mm, on a plateau of 240 that falls to 180: polynomials do not follow it."""
    tau = 240 + 110 * np.exp(-(((S - 3.2) / 0.9) ** 4)) - 60 * (S > 6.5) + noise(800, 12)
    shear = sheared(with_stress(tau))
    assert shear.peak.value < 325
    assert shear.smoothed.value == pytest.approx(350, abs=2 * shear.smoothed.value_error)
    assert shear.peaks_differ
    assert any("is not that of the smoothed data" in remark for remark in shear.remarks)
    assert shear.residual > 10


def test_residual_of_a_polynomial_is_the_noise() -> None:
    """White noise of 4 kPa on a parabola, averaged over blocks of n rows: 4 / sqrt(n)."""
    tau = 100 - 2 * (S - 4) ** 2 + 4 * np.random.default_rng(3).normal(size=800)
    shear = sheared(with_stress(tau))
    assert not shear.peaks_differ
    assert shear.residual == pytest.approx(4 / np.sqrt(shear.tau.rows_per_block), rel=0.1)


def test_peaks_agree_where_there_is_one() -> None:
    found = [sheared(curves(200, 8, seed=seed)).peaks_differ for seed in range(1, 5)]
    assert not any(found)


def test_a_fast_test_is_not_quasi_static() -> None:
    """I grows with the speed: d = sqrt(4 A / pi) with A = 0.835 width height / 350 makes 0.0289 e-3 at 100 kPa and 2 mm/s."""
    slow, fast = sheared(curves(200, 8)), sheared(curves(200, 8), speed=200)
    assert slow.inertia.number == pytest.approx(2.04e-5, rel=0.02)
    assert fast.inertia.number == pytest.approx(100 * (slow.inertia.number or 0))
    assert fast.verdicts["quasi_static"].holds is False
    assert "not quasi-static; shear more slowly" in fast.remarks
    assert "inertial number 2.0" in fast.verdicts["quasi_static"].reason
    assert fast.doubt is None


def test_halves_that_swing_are_not_quasi_static() -> None:
    data = curves(200, 8)
    data["tau_upper_kPa"] = data["tau_kPa"] + 30 * np.sin(40 * S)
    assert "τ of the halves differs by 2" in sheared(data).verdicts["quasi_static"].reason


def test_what_is_not_recorded_is_not_judged() -> None:
    data = curves(200, 8)
    del data["tau_upper_kPa"]
    shear = sheared(data, bed={})
    assert shear.verdicts["quasi_static"].holds is None and shear.remarks == []


def test_dilatancy_of_a_straight_lid() -> None:
    """0.2 mm/mm: 11.3 degrees, at the peak and at the end."""
    shear = sheared({**curves(200, 8), "lid_mm": 0.2 * S})
    assert shear.at_peak.dilation_deg == pytest.approx(np.degrees(np.arctan(0.2)))
    assert shear.at_end.dilation_deg == pytest.approx(np.degrees(np.arctan(0.2)))
    assert shear.at_end.ratio == pytest.approx(np.mean(shear.data["tau_kPa"][640:]) / 200)


def test_a_stress_that_never_changes_is_no_strength() -> None:
    """There is nothing to tell its error by."""
    data = curves(200, 8)
    shear = sheared(data | {"tau_kPa": np.full(len(data["step"]), 50.0)})
    assert shear.doubt == "τ = 50 kPa without any scatter: how uncertain it is cannot be told"


def test_an_edge_on_the_shear_plane_is_told() -> None:
    """Though the lower half has its peak within the travel."""
    data = curves(200, 8)
    plane = {"plane_kPa": np.full(800, 200.0), "plane_tau_kPa": 10 * S + noise(800, 1)}
    (remark,) = sheared(data | plane).remarks
    assert remark == "τ on the shear plane has no peak within the travel; its greatest value is taken"
    assert not sheared(data | plane | {"plane_tau_kPa": data["tau_kPa"]}).remarks


def test_peaks_on_the_shear_plane_are_judged_as_that_of_the_lower_half_is() -> None:
    """By their error."""
    data = curves(200, 8)
    uncertain = {"plane_kPa": np.full(800, 200.0), "plane_tau_kPa": data["tau_kPa"] / 10 + noise(800, 40)}
    assert "too uncertain" in (sheared(data | uncertain).plane_doubt or "")
    assert any("on the shear plane cannot be judged" in text for text in sheared(data | uncertain).remarks)
    certain = uncertain | {"plane_tau_kPa": data["tau_kPa"]}
    assert sheared(data | certain).plane_doubt is None and sheared(data | certain).doubt is None


def test_dilatancy_of_a_peak_at_the_end_is_held() -> None:
    """The lid's rise fades away, with scatter: its angle is known to a degree, that of the polynomial's end is not."""
    found, ends = [], []
    for seed in range(12):
        data = with_stress(10 * S + noise(800, 0.1, seed))
        shear = sheared(data | {"lid_mm": np.sin(np.pi * S / 16) + noise(800, 0.02, seed + 100)})
        assert shear.peak.at_boundary and shear.peak.position == shear.lid.span
        found.append(shear.at_peak.dilation_deg)
        ends.append(np.degrees(np.arctan(shear.lid.series.deriv()(shear.lid.span))))
    assert np.sqrt(np.mean(np.square(found))) < 1.5 < np.sqrt(np.mean(np.square(ends)))
