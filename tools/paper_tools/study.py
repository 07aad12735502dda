# SPDX-License-Identifier: GPL-2.0-or-later
"""The campaigns of the study, and what is made of their results."""

import tomllib
from collections.abc import Mapping
from pathlib import Path

from shearbox_tools import __version__
from shearbox_tools.errors import ShearboxError

from .figures import draw
from .findings import Finding, findings, halves_agree, of_the_laws
from .outlook import SWEEPS, study
from .page import HALVES, OF_MODELS, OF_WALLS, core_hours, print_page, record, strengths, table_3, write_page
from .specimens import Group, read_groups

WALLS = ("smooth", "discs")
CAMPAIGNS = (*WALLS, "incremental", *(sweep.name for sweep in SWEEPS))


def campaign_file(name: str) -> Path:
    """Of shearbox run."""
    return Path(__file__).parent / "campaigns" / f"{name}.toml"


def runs_of(name: str) -> list[str]:
    """The names of its runs."""
    return list(tomllib.loads(campaign_file(name).read_text(encoding="utf-8"))["runs"])


def report(folder: Path) -> Path:
    """Write page, figures and tables of the campaigns in the folder; the path of the page."""
    groups = {name: read_groups(folder / name) for name in CAMPAIGNS}
    smooth = groups["smooth"]
    if not smooth:
        raise ShearboxError(f"{folder / 'smooth'}: no specimen of the models is complete yet")
    found = {walls: findings(groups[walls]) for walls in WALLS if groups[walls]}
    found["smooth"] += of_the_laws(smooth, groups["incremental"])
    models = {walls: [(g, strengths(g)) for g in groups[walls].values()] for walls in found}
    specimens = [one for some in groups.values() for group in some.values() for one in group.specimens]
    studies = [study(sweep, groups[sweep.name], smooth, folder / "figures") for sweep in SWEEPS]
    record(found, groups, folder)
    page = write_page(
        folder,
        version=__version__,
        speeds=sorted({f"{g.ensemble.identity['speed_mm_s']:g}" for some in models.values() for g, _ in some}),
        stresses=sorted({f"{sigma:g}" for group in smooth.values() for sigma in group.ensemble.shears}),
        specimens=len(specimens),
        tests=sum(len(one.tests) for one in specimens),
        hours=sum(map(core_hours, groups.values())),
        missing=_missing(groups),
        findings=found,
        claims=_side_by_side(found),
        halves=halves_agree(smooth, HALVES) if any(len(g.specimens) > 3 for g in smooth.values()) else None,
        models=models,
        of_models=OF_MODELS,
        of_walls=OF_WALLS,
        names=sorted({group.model for rows in models.values() for group, _ in rows}),
        by_name={walls: {group.model: values for group, values in rows} for walls, rows in models.items()},
        pictures=draw(smooth, folder / "figures"),
        table_3=[(group, table_3(group)) for group in smooth.values()],
        studies=[one for one in studies if one],
    )
    print_page(page)
    return page


def _side_by_side(found: Mapping[str, list[Finding]]) -> list[list[Finding]]:
    """Each claim with all kinds of walls that it was judged for."""
    claims = list(dict.fromkeys(one.claim for some in found.values() for one in some))
    return [[one for some in found.values() for one in some if one.claim == claim] for claim in claims]


def _missing(groups: Mapping[str, Mapping[str, Group]]) -> list[str]:
    """Of each campaign how many specimens there are, of how many, unless that is all."""
    missing = []
    for name in CAMPAIGNS:
        tables = tomllib.loads(campaign_file(name).read_text(encoding="utf-8"))
        asked = sum((tables["all"] | table)["seeds"] for table in tables["runs"].values())
        there = sum(len(group.specimens) for group in groups[name].values())
        if there < asked:
            missing.append(f"{name}: {there} of {asked} specimens")
    return missing
