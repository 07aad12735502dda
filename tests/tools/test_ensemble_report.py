# SPDX-License-Identifier: GPL-2.0-or-later
"""The report on many runs: which of them belong together, what their means and shares are, what is left out."""

import errno
import json
import os
import shutil
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import synthetic
from ensembles import FACTORS, REQUEST, base, only, write_run
from shearbox_tools.analysis.ensemble_results import INDEPENDENT, SHARED, Ensemble
from shearbox_tools.analysis.grouping import put_together, what_differs, what_is_set
from shearbox_tools.analysis.mean_curve import average
from shearbox_tools.analysis.quasistatic import Inertia
from shearbox_tools.analysis.results import Results, read_results
from shearbox_tools.analysis.shear import Shear
from shearbox_tools.analysis.stress_dilatancy import Dilatant
from shearbox_tools.asking.models import PARAMETERS, read_variables
from shearbox_tools.asking.request import OWN_OPTION
from shearbox_tools.base.errors import ShearboxError
from shearbox_tools.reports.ensemble_summary import summarise_all
from shearbox_tools.reports.report_on import report_on
from shearbox_tools.running.run_folders import find_runs


@pytest.fixture(name="runs", scope="module")
def _runs(tmp_path_factory: pytest.TempPathFactory) -> list[Results]:
    """Specimens of seeds 1, 2, 3; the lid of the last sinks."""
    folder = tmp_path_factory.mktemp("specimens")
    return [
        read_results(write_run(folder / f"seed_{n}", replace(REQUEST, seed=n), factor, lid=-1 if n == 3 else 1))
        for n, factor in FACTORS.items()
    ]


def with_identity(run: Results, **changes: Any) -> Results:
    return replace(run, identity=run.identity | changes)


def test_runs_that_differ_in_more_than_their_seeds_are_not_put_together(runs: list[Results]) -> None:
    one, two, three = runs
    fast = [with_identity(run, speed_mm_s=10) for run in (one, two)]
    rough = with_identity(three, parameters=one.identity["parameters"] | {"phi": "30"})
    ensembles, left_out = put_together([one, fast[0], two, rough, fast[1], with_identity(three, speed_mm_s=2)])
    assert not left_out
    assert [[run.identity["seed"] for run in ensemble.specimens] for ensemble in ensembles] == [[1, 2, 3], [1, 2], [3]]
    assert what_differs(ensembles) == ["speed 2 mm/s, φ_μ 27°", "speed 10 mm/s, φ_μ 27°", "speed 2 mm/s, φ_μ 30°"]


def test_a_packing_counts_once(runs: list[Results]) -> None:
    copied = replace(runs[0], folder=Path("copy"))
    (ensemble,), (left_out,) = put_together([*runs, copied])
    assert ensemble.count == 3
    assert left_out.folder == Path("copy") and "the same packing as" in left_out.reason


def test_the_mean_curve_is_the_mean_at_equal_displacements(runs: list[Results]) -> None:
    """Of curves f tau(s) it is the mean of f times tau, and the deviation that of f: no grid is in it.

    The tables have ten digits.
    """
    curve = average([run.shears[1] for run in runs])
    factors = np.array(list(FACTORS.values()))
    tau = np.interp(curve.displacement, base(200)["displacement_mm"], base(200)["tau_kPa"])
    assert curve.tau.mean == pytest.approx(factors.mean() * tau, rel=1e-8)
    assert curve.tau.deviation == pytest.approx(factors.std(ddof=1) * tau, rel=1e-8)
    assert curve.tau.error == pytest.approx(factors.std(ddof=1) / np.sqrt(3) * tau, rel=1e-8)
    assert curve.peak.value == pytest.approx(np.mean([run.shears[1].peak.value for run in runs]), rel=1e-6)


def test_specimens_that_peak_elsewhere_have_a_lower_mean(runs: list[Results]) -> None:
    """Two curves with peaks of equal height apart: the mean has none as high."""
    shear = runs[1].shears[1]
    s = shear.data["displacement_mm"]
    late = shear.data | {"tau_kPa": synthetic.softening(s, 105, 4, 60)}
    curve = average([shear, replace(shear, data=late)])
    assert curve.peak.value < 104
    assert curve.tau.mean.max() == pytest.approx(np.max((shear.data["tau_kPa"] + late["tau_kPa"]) / 2), abs=0.01)


def test_curves_of_other_lengths_are_averaged_where_all_are(runs: list[Results]) -> None:
    shear = runs[0].shears[0]
    curve = average([shear, replace(shear, rows=slice(10, 700))])
    s = shear.data["displacement_mm"]
    assert (curve.displacement[0], curve.displacement[-1]) == pytest.approx((max(s[10], s[shear.rows][0]), s[699]))
    assert curve.tau.deviation == pytest.approx(0, abs=2e-3), "the same curve, interpolated between its rows"


def test_strength_is_that_of_the_specimens_own_lines(runs: list[Results]) -> None:
    """tau / sigma = tan(phi) + c / sigma by least squares, specimen by specimen; numpy's fit knows nothing of ours."""
    ensemble = Ensemble(runs)
    lines = [
        np.polyfit([1 / s.sigma for s in run.shears], [s.peak.value / s.sigma for s in run.shears], 1) for run in runs
    ]
    c, slope = np.mean(lines, axis=0)
    assert ensemble.model == SHARED and ensemble.strength
    assert float(ensemble.strength.c_kPa.value) == pytest.approx(c)
    assert float(ensemble.strength.phi_deg.value) == pytest.approx(np.degrees(np.arctan(slope)))
    ratios = [np.mean([s.at_end.ratio for s in run.shears]) for run in runs]
    ultimate = ensemble.ultimate_angle
    assert ultimate and float(ultimate.value) == pytest.approx(np.degrees(np.arctan(np.mean(ratios))))


def test_strength_by_the_shear_plane(runs: list[Results]) -> None:
    """Where the plane has 1.25 times the lid's stress and 0.8 of the lower half's, cohesion is 0.8 times as large and
    tan(phi) 0.8/1.25 times; and where they are not known, there is none."""

    def on_plane(shear: Shear) -> Shear:
        normal = np.full(len(shear.data["step"]), 1.25 * shear.sigma)
        return replace(shear, data=shear.data | {"plane_kPa": normal, "plane_tau_kPa": 0.8 * shear.data["tau_kPa"]})

    known = Ensemble([replace(run, shears=[on_plane(shear) for shear in run.shears]) for run in runs])
    lid, plane = known.strength, known.plane_strength
    assert lid and plane and Ensemble(runs).plane_strength is None
    assert plane.c_kPa.value == pytest.approx(0.8 * lid.c_kPa.value)
    assert np.tan(np.radians(plane.phi_deg.value)) == pytest.approx(np.tan(np.radians(lid.phi_deg.value)) * 0.8 / 1.25)

    def uncertain(shear: Shear) -> Shear:
        tau = 5 + synthetic.correlated_noise(np.random.default_rng(1), len(shear.data["step"]), 40, 8)
        return replace(shear, data=shear.data | {"plane_tau_kPa": tau})

    first, *others = known.specimens
    doubtful = replace(first, shears=[uncertain(first.shears[0]), *first.shears[1:]])
    assert first.plane_line and doubtful.line and doubtful.plane_line is None, "a peak that cannot be judged"
    ensemble = Ensemble([doubtful, *others])
    assert ensemble.strength and ensemble.plane_strength is None


def test_a_packing_for_each_stress_is_another_model(runs: list[Results]) -> None:
    """All peaks are on a line c + sigma tan(phi), so the interval has no width."""
    single = [only(run, sigma) for run, sigma in zip(runs, (100.0, 200.0, 300.0))]
    ensemble = Ensemble(single)
    assert ensemble.model == INDEPENDENT and ensemble.strength and not ensemble.doubts
    assert ensemble.strength.phi_deg.deviation is None
    assert ensemble.share("proportional") == (0, 0), "no specimen has three stresses"
    assert Ensemble(single[:2]).doubts == ["2 peaks: at least 3 are needed"]


def test_stresses_that_some_lack_are_averaged_and_not_part_of_the_line(runs: list[Results]) -> None:
    ensemble = Ensemble([*runs[:2], only(runs[2], 100.0, 300.0)])
    assert ensemble.common == [100, 300]
    assert [len(shears) for shears in ensemble.shears.values()] == [3, 2, 3]
    assert ensemble.strength
    assert "at least 2" in Ensemble([runs[0], only(runs[1], 100.0)]).doubts[0]


def test_shares_of_specimens(runs: list[Results]) -> None:
    """The lid of one of three sinks; the mean, (1 + 1 - 1) / 3 of a rise, does not tell."""
    ensemble = Ensemble(runs)
    assert ensemble.share("dilates") == (2, 3)
    assert ensemble.verdicts["dilates"].holds is None
    why = "open at 100 kPa, 200 kPa, 300 kPa: the 95 % interval of the mean holds 0; more specimens would tell"
    assert ensemble.verdicts["dilates"].reason == why
    assert ensemble.share("proportional") == (3, 3) and ensemble.verdicts["proportional"].holds
    assert Ensemble(runs[:2]).verdicts["dilates"].holds, "two equal rises leave no doubt"


def all_with(runs: Sequence[Results], **changes: Any) -> list[Results]:
    return [replace(run, shears=[replace(shear, **changes) for shear in run.shears]) for run in runs]


def test_what_no_specimen_tells_the_mean_does_not(runs: list[Results]) -> None:
    """8 mm are 0.8 % of a box of a metre: too short for any peak, of one specimen or of several."""
    for count in (1, 2):
        ensemble = Ensemble(all_with(runs[:count], width=1000.0))
        features = {name: v for name, v in ensemble.verdicts.items() if name != "quasi_static"}
        assert [verdict.holds for verdict in features.values()] == [None] * 3
        for verdict in (v for of in ensemble.verdicts_by_stress.values() for name, v in of.items() if name in features):
            assert verdict.holds is None
            assert verdict.reason.startswith("sheared by 0.8 % of the width (≥ 1 %); so far ")
            assert verdict.reason.count("so far") == 1
        assert features["proportional"].reason.startswith("not all peaks can be judged; so far ")
        assert features["dilates"].reason == "cannot be judged at 100 kPa, 200 kPa, 300 kPa"


def test_quasi_static_is_told_with_the_greatest_numbers(runs: list[Results]) -> None:
    limits = [Inertia(2.9e-3, 0.1), Inertia(1e-4, 40.0), Inertia(1e-4, 0.2)]
    fast = [one for run, inertia in zip(runs, limits) for one in all_with([run], inertia=inertia)]
    verdict = Ensemble(fast).verdicts_by_stress[100]["quasi_static"]
    assert verdict.holds is False
    numbers = "inertial number 2.90e-3 (≤ 1e-3), τ of the halves differs by 40.0 % (≤ 5 %)"
    assert verdict.reason == f"in 1 of 3 specimens; at most: {numbers}"


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    "factor, doubt",
    [(0.0, "100 kPa: τ at its peak is 0 kPa: a strength is above 0"), (-1.0, "100 kPa: τ at its peak is -")],
)
def test_a_test_that_nothing_resists_is_reported_on(tmp_path: Path, factor: float, doubt: str) -> None:
    """As of a half that moves without grains on it, or is pushed along: there is no strength, and the report says why."""
    for seed in (1, 2):
        folder = write_run(tmp_path / f"seed_{seed}", replace(REQUEST, seed=seed), factor)
    report_on(tmp_path)
    alone = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    (both,) = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["ensembles"]
    assert alone["phi_deg"] is None and alone["doubts"][0].startswith(doubt)
    assert both["phi_deg"] is None and doubt in both["doubts"][0]
    for summary in (alone, both):
        assert [c["holds"] for name, c in summary["criteria"].items() if name != "quasi_static"] == [None] * 3


def states(peak: Dilatant, end: Dilatant) -> Results:
    return SimpleNamespace(shears=[SimpleNamespace(sigma=100.0, at_peak=peak, at_end=end)])  # type: ignore[return-value]


def by_rowe(critical: float, psi: float) -> Dilatant:
    """The state with dilation angle psi, in degrees: s1/s3 is that of phi_cv times (1 + sin psi) / (1 - sin psi)."""
    k = np.prod([(1 + np.sin(np.radians(a))) / (1 - np.sin(np.radians(a))) for a in (critical, psi)])
    sine, psi = (k - 1) / (k + 1), np.radians(psi)
    return Dilatant(float(sine * np.cos(psi) / (1 - sine * np.sin(psi))), float(np.tan(psi)))


def test_a_relation_that_holds_changes_nothing_from_peak_to_end() -> None:
    """Specimens that follow Rowe, each with a phi_cv of its own."""
    every = Ensemble([states(by_rowe(cv, psi), by_rowe(cv, 0)) for cv, psi in ((24, 10), (27, 15), (25, 12))])
    rowe, bolton = every.change_of_critical("rowe"), every.change_of_critical("bolton")
    assert rowe and bolton
    assert [float(rowe.low), float(rowe.high)] == pytest.approx([0, 0], abs=1e-9)
    assert float(bolton.value) != pytest.approx(0, abs=0.1)


class Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []
        self.open: list[str] = []
        self.text = ""

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = dict(attributes)
        self.found += [value for name in ("href", "src") if (value := values.get(name)) is not None]
        if tag not in ("meta", "br", "img"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


@pytest.fixture(name="folder", scope="module")
def _folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two specimens, one at another speed, one that was stopped and one whose record is damaged; each at its own depth."""
    folder = tmp_path_factory.mktemp("many")
    two = replace(REQUEST, stresses=(100.0, 300.0))
    write_run(folder / "slow" / "seed_2", replace(two, seed=2))
    write_run(folder / "slow" / "seed_10", replace(two, seed=10), 1.1)
    write_run(folder / "fast", replace(two, speed=10.0))
    write_run(folder / "stopped", replace(REQUEST, seed=3, stresses=(100.0,)), rows=400)
    write_run(folder / "damaged", replace(REQUEST, seed=4, stresses=(100.0,)))
    (folder / "damaged" / "run.json").write_text("{", encoding="utf-8")
    with pytest.raises(ShearboxError, match="is written, but not all files can be read:\n.*damaged/run.json, line 1"):
        report_on(folder)
    return folder


def test_the_page_is_well_formed_and_its_links_lead_somewhere(folder: Path) -> None:
    page = Links()
    page.feed((folder / "report.html").read_text(encoding="utf-8"))
    assert not page.open
    files = [link for link in page.found if not link.startswith(("data:", "#"))]
    assert {"slow/seed_2/report.html", "fast/report.html", "curves_1.csv", "curves_2.csv"} <= set(files)
    assert all((folder / link).exists() for link in files)
    for words in (
        "standard error of the mean",
        "standard deviation from specimen to specimen",
        "fit alone",
        "packings of this model, with",
    ):
        assert words in " ".join(page.text.split()), words


def test_tables_of_an_earlier_report_do_not_stay(tmp_path: Path) -> None:
    """Of two ensembles there are two tables, in the place of that of one; what no report has written stays."""
    (tmp_path / "curves_7.csv").write_text("mine", encoding="utf-8")
    two = replace(REQUEST, stresses=(100.0,))
    for request, written in ((two, ["curves.csv"]), (replace(two, speed=10.0), ["curves_1.csv", "curves_2.csv"])):
        write_run(tmp_path / f"{request.speed:g}", request)
        report_on(tmp_path, each=False)
        assert sorted(path.name for path in tmp_path.glob("curves*")) == sorted([*written, "curves_7.csv"])


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("name", ["grains", "contacts"])
def test_pictures_do_not_decide_which_specimens_count(tmp_path: Path, name: str) -> None:
    """Whether each run has a report of its own, whose pictures show a damage of a dump, or not."""
    folders = [write_run(tmp_path / f"seed_{n}", replace(REQUEST, seed=n), factor) for n, factor in FACTORS.items()]
    for sigma in REQUEST.stresses:
        synthetic.write_frames(folders[2] / f"{sigma:g}", [0, 2000000, 4000000], 8)
    dump = folders[2] / "100" / f"{name}.dump"
    first, *rows = dump.read_text(encoding="utf-8").splitlines()
    dump.write_text("\n".join([first, *rows[:-1], "nonsense"]) + "\n", encoding="utf-8")
    phis = []
    for each in (True, False):
        with suppress(ShearboxError):
            report_on(tmp_path, each=each)
        summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
        (ensemble,) = summary["ensembles"]
        assert len(ensemble["specimens"]) == 3 and not summary["left_out"]
        phis.append(ensemble["phi_deg"]["value"])
    assert phis[0] == phis[1]
    with pytest.raises(ShearboxError, match=f"seed_3/100/{name}.dump"):
        report_on(tmp_path)
    own = json.loads((folders[2] / "summary.json").read_text(encoding="utf-8"))
    assert own["complete"] and f"{name}.dump" in own["problems"][0]


def test_the_summary_says_what_is_left_out(folder: Path) -> None:
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    found = {one["differs"]: [s["folder"] for s in one["specimens"]] for one in summary["ensembles"]}
    assert found == {"speed 10 mm/s": ["fast"], "speed 2 mm/s": ["slow/seed_2", "slow/seed_10"]}
    reasons = {one["folder"]: one["reason"] for one in summary["left_out"]}
    assert "sheared to 3.99" in reasons["stopped"] or "sheared to 4.00 mm only" in reasons["stopped"]
    assert "run.json" in reasons["damaged"]
    alone, both = summary["ensembles"]
    assert alone["phi_deg"] is None and alone["fit_alone"]["phi_deg"] > 0
    assert both["phi_deg"]["low"] < both["phi_deg"]["value"] < both["phi_deg"]["high"] and both["fit_alone"] is None


def test_the_table_has_the_curves(folder: Path) -> None:
    table: np.ndarray = np.genfromtxt(folder / "curves_2.csv", delimiter=",", names=True)
    assert sorted(set(table["sigma_kPa"])) == [100, 300] and set(table["specimens"]) == {2}
    assert table["tau_standard_error_kPa"] == pytest.approx(table["tau_standard_deviation_kPa"] / np.sqrt(2), rel=1e-6)


def test_nothing_complete_is_no_report(tmp_path: Path) -> None:
    write_run(tmp_path / "a", replace(REQUEST, stresses=(100.0,)), rows=300)
    with pytest.raises(ShearboxError, match="no specimen is complete yet\n.*100 kPa"):
        report_on(tmp_path)
    assert not (tmp_path / "report.html").exists()
    with pytest.raises(ShearboxError, match="holds no run"):
        report_on(tmp_path / "a" / "100" / "none")


def test_runs_are_found_at_any_depth_but_not_within_runs(folder: Path) -> None:
    inner = folder / "fast" / "100" / "run.json"
    shutil.copy(folder / "fast" / "run.json", inner)
    names = [str(path.relative_to(folder)) for path in find_runs(folder)]
    inner.unlink()
    assert names == ["damaged", "fast", "slow/seed_2", "slow/seed_10", "stopped"]
    assert find_runs(folder / "fast") == [folder / "fast"]


def test_a_folder_that_cannot_be_read_is_named(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Rather than left out of a mean; modes do not stop root, who may run this."""
    scan = os.scandir

    def locked(path: Any) -> Any:
        if Path(path) == folder / "slow":
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return scan(path)

    monkeypatch.setattr(os, "scandir", locked)
    with pytest.raises(ShearboxError, match="slow: this folder cannot be read: Permission denied"):
        find_runs(folder)


def test_what_is_set_is_told() -> None:
    usual = read_variables(PARAMETERS)
    of_file = {name: value for name, value in usual.items() if name not in OWN_OPTION}
    identity = REQUEST.identity(of_file | {"phi": "35.0", "kn": "1e8"})  # kn as it is, in other words
    identity |= {"stiffness": 0.1, "model dmin": 0.0045}
    run = SimpleNamespace(identity=identity, model_file=REQUEST.model.path)
    ensemble: Any = SimpleNamespace(identity=identity, specimens=[run])
    assert what_is_set(ensemble) == "dmin 0.0045, stiffness 0.1, φ_μ 35°"
    run.model_file = Path("gone.in")
    assert what_is_set(ensemble) == "stiffness 0.1, φ_μ 35°"


def test_means_over_stresses_are_of_those_that_all_have(runs: list[Results]) -> None:
    one, two, three = runs
    fewer = replace(two, stresses=[100.0, 200.0], shears=two.shears[:2])
    mean = Ensemble([one, fewer, three]).over_specimens(lambda shear: shear.sigma)
    assert mean and [float(value) for value in (mean.value, mean.low, mean.high)] == [150, 150, 150]
    apart = [replace(run, stresses=[shear.sigma], shears=[shear]) for run, shear in zip(runs, one.shears)]
    each = Ensemble(apart).over_specimens(lambda shear: shear.sigma)
    assert each and each.value == 200, "each stress has a packing of its own"
    none = [replace(one, shears=one.shears[:1]), replace(two, shears=two.shears[1:])]
    assert Ensemble([*none, three]).over_specimens(lambda shear: shear.sigma) is None


def test_a_line_of_peaks_that_are_in_doubt_is_not_shown(runs: list[Results]) -> None:
    """In the table of specimens, as it is not in the report on that one."""
    one, two, three = runs
    short = replace(one, shears=[replace(one.shears[0], complete=False), *one.shears[1:]])
    summary = summarise_all(one.folder.parent, [Ensemble([short, two, three])], [], ["curves.csv"])
    first, second, _ = summary["ensembles"][0]["specimens"]
    assert short.line and first["phi_deg"] is None and second["phi_deg"] > 0


def test_models_of_a_name_are_told_apart_by_their_variables(runs: list[Results]) -> None:
    """Those of another name are told apart by it."""
    finer = with_identity(runs[0], **{"model dmin": 0.003, "model ngrains": 500})
    other = with_identity(runs[0], model="other", **{"model dmin": 0.002})
    ensembles, _ = put_together([runs[0], finer, other])
    assert what_differs(ensembles) == ["dmin 0.004, ngrains 350", "dmin 0.003, ngrains 500", ""]


def test_specimens_behind_links_are_found_once(tmp_path: Path) -> None:
    for name in ("all/seed_1", "scratch/seed_2"):
        (tmp_path / name).mkdir(parents=True)
        (tmp_path / name / "run.json").write_text("{}", encoding="utf-8")
    (tmp_path / "all" / "seed_2").symlink_to(tmp_path / "scratch" / "seed_2")
    (tmp_path / "all" / "again").symlink_to(tmp_path / "scratch" / "seed_2")
    (tmp_path / "all" / "round").symlink_to(tmp_path / "all")
    assert len(find_runs(tmp_path / "all")) == 2
    assert find_runs(tmp_path / "all" / "10²") == []
