# SPDX-License-Identifier: GPL-2.0-or-later
"""The campaigns of the study, and what is made of their results."""

import math
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any

from shearbox_tools import __version__
from shearbox_tools.base.errors import ShearboxError

from .figures import draw
from .findings import Finding, findings, halves_agree, of_the_laws
from .outlook import SWEEPS, study
from .page import HALVES, OF_MODELS, OF_STRESSES, OF_WALLS, print_page, strengths, table_3, write_findings, write_page
from .record import Campaigns, write_record
from .specimens import Group, Specimen, read_specimens

WALLS = ("smooth", "discs")
CAMPAIGNS = (*WALLS, "incremental", *(sweep.name for sweep in SWEEPS))


def campaign_file(name: str) -> Path:
    """Of shearbox run."""
    return Path(__file__).parent / "campaigns" / f"{name}.toml"


@cache
def runs_of(name: str) -> Mapping[str, Mapping[str, Any]]:
    """Its runs by name, with all of their options."""
    tables = tomllib.loads(campaign_file(name).read_text(encoding="utf-8"))
    return {run: tables["all"] | table for run, table in tables["runs"].items()}


@dataclass(frozen=True)
class Part:
    """Runs of a campaign that are to be made at a time: of each as many specimens as the campaign asks for, or these seeds."""

    runs: list[str]
    seeds: list[int] | None = None


def parts_left(name: str, only: Iterable[str], kept: Campaigns) -> list[Part]:
    """Of the runs of a campaign what is not among the specimens that are kept."""
    left = {run: _seeds_left(runs_of(name)[run]["seeds"], kept.get(name, {}).get(run, [])) for run in only}
    untouched = [run for run, seeds in left.items() if len(seeds) == runs_of(name)[run]["seeds"]]
    begun = sorted((seeds, run) for run, seeds in left.items() if seeds and run not in untouched)
    parts = [Part(untouched)] if untouched else []
    return parts + [Part([run for _, run in some], seeds) for seeds, some in groupby(begun, lambda one: one[0])]


def _seeds_left(asked: int, there: Iterable[Specimen]) -> list[int]:
    return sorted(set(range(1, asked + 1)) - {one.seed for one in there})


def report(folder: Path, kept: Campaigns) -> Path:
    """Write page, figures and tables of the campaigns in the folder and of the specimens kept; the path of the page."""
    read = {name: read_specimens(folder / name) for name in CAMPAIGNS}
    campaigns = {name: _together(specimens, kept.get(name, {})) for name, (specimens, _) in read.items()}
    if not campaigns["smooth"]:
        raise ShearboxError(f"{folder / 'smooth'}: no specimen of the models is complete yet")
    folder.mkdir(parents=True, exist_ok=True)
    groups = {name: _groups(name, entries) for name, entries in campaigns.items()}
    smooth = groups["smooth"]
    found = {walls: findings(groups[walls]) for walls in WALLS if groups[walls]}
    found["smooth"] += of_the_laws(smooth, groups["incremental"])
    models = {walls: [(g, strengths(g)) for g in groups[walls].values()] for walls in found}
    specimens = [one for some in groups.values() for group in some.values() for one in group.specimens]
    studies = [study(sweep, groups[sweep.name], smooth, folder / "figures") for sweep in SWEEPS]
    write_findings(found, folder)
    write_record(campaigns, folder)
    page = write_page(
        folder,
        version=__version__,
        speeds=sorted({f"{group.speed:g}" for some in models.values() for group, _ in some}),
        stresses=sorted({f"{sigma:g}" for group in smooth.values() for sigma in group.stresses}),
        specimens=len(specimens),
        kept=sum(len(some) for entries in kept.values() for some in entries.values()),
        tests=sum(len(one.tests) for one in specimens),
        hours=sum(one.hours for one in specimens if math.isfinite(one.hours)),
        missing=_missing(groups),
        damaged=[one for _, some in read.values() for one in some],
        findings=found,
        claims=_side_by_side(found),
        halves=halves_agree(smooth, HALVES) if any(len(g.specimens) > 3 for g in smooth.values()) else None,
        models=models,
        of_models=OF_MODELS,
        of_walls=OF_WALLS,
        of_stresses=OF_STRESSES,
        names=sorted({group.model for rows in models.values() for group, _ in rows}),
        by_name={walls: {group.model: values for group, values in rows} for walls, rows in models.items()},
        pictures=draw(smooth, folder / "figures"),
        table_3=[(group, table_3(group)) for group in smooth.values()],
        studies=[one for one in studies if one],
    )
    print_page(page)
    return page


def _together(new: Mapping[str, list[Specimen]], kept: Mapping[str, list[Specimen]]) -> dict[str, list[Specimen]]:
    """By entry; of the same seed the new one."""
    entries = {}
    for name in sorted(new.keys() | kept.keys()):
        by_seed = {one.seed: one for one in [*kept.get(name, []), *new.get(name, [])]}
        entries[name] = [by_seed[seed] for seed in sorted(by_seed)]
    return entries


def _groups(campaign: str, entries: Mapping[str, list[Specimen]]) -> dict[str, Group]:
    if unknown := [name for name in entries if name not in runs_of(campaign)]:
        raise ShearboxError(f"{campaign}/{unknown[0]}: specimens of a run that {campaign_file(campaign)} does not have")
    asked = {name: runs_of(campaign)[name] for name in entries}
    return {name: Group(name, asked[name]["model"], asked[name]["speed"], some) for name, some in entries.items()}


def _side_by_side(found: Mapping[str, list[Finding]]) -> list[list[Finding]]:
    """Each claim with all kinds of walls that it was judged for."""
    claims = list(dict.fromkeys(one.claim for some in found.values() for one in some))
    return [[one for some in found.values() for one in some if one.claim == claim] for claim in claims]


def _missing(groups: Mapping[str, Mapping[str, Group]]) -> list[str]:
    """Of each campaign how many specimens there are, of how many, unless that is all."""
    missing = []
    for name in CAMPAIGNS:
        asked = sum(run["seeds"] for run in runs_of(name).values())
        there = sum(min(len(g.specimens), runs_of(name)[run]["seeds"]) for run, g in groups[name].items())
        if there < asked:
            missing.append(f"{name}: {there} of {asked} specimens")
    return missing
