# SPDX-License-Identifier: GPL-2.0-or-later
"""What the paper says, claim by claim, as hypotheses with a rule for each, and what the campaigns say of them.

A verdict is that of the effect over all boxes; rows beside it are single boxes. The rules are this project's.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from .effects import (
    CONFIRMED,
    CONTRADICTED,
    OPEN,
    Effect,
    difference,
    mean,
    paired,
    share,
    unknown,
)
from .over_groups import common_difference, mean_of_groups, slope
from .specimens import Group, Specimen, missed

BOXES = "ABCD"
WIDTHS = {"A": 10, "B": 15, "C": 20, "D": 30}  # cm
COARSE, FINE, FINEST, TRIPLE = "4-8", "2-4", "T-2", "2-4_triple"
STRENGTH = (
    ("phi", "φ (lid)"),
    ("phi_plane", "φ (shear plane)"),
    ("peak", "the shear strength, greatest τ/σ"),
    ("mean", "the mean τ/σ"),
    ("end", "the ultimate τ/σ"),
)
ALIKE = 0.05  # two estimates of a peak that are no further apart are one
SHARP = 1.25  # a peak is sharp whose stress is a quarter above that of the last fifth: as of dense sands
EXCEPTION = "C_2-4"  # Fig. 9

Groups = Mapping[str, Group]


@dataclass(frozen=True)
class Finding:
    """A claim, where the paper has it, how it is judged, the effects, the first `deciding` of which do, and the verdict."""

    claim: str
    source: str
    rule: str
    effects: list[Effect]
    verdict: str
    deciding: int = 1


def findings(groups: Groups) -> list[Finding]:
    """All of them, of a campaign with one kind of walls."""
    return [
        _features(groups),
        *(_sharp(groups, kind) for kind in ("single", "triple")),
        _falling(groups),
        _finer(groups, "late_rate", "The finer the single discs, the less the lid rises in the second half", "③ 1)"),
        *(_finer(groups, name, f"The finer the single discs, the lower {what}", "③ 1)") for name, what in STRENGTH),
        *(_larger(groups, name, what) for name, what in STRENGTH),
        _finer(
            groups, "trm", "The finer the single discs, the more they roll: TRM at the end", "3.3, roller effect", 1
        ),
        *_triples(groups),
        _polynomials(groups),
    ]


def _features(groups: Groups) -> Finding:
    """All three features in all specimens, without Fig. 9's model; rows are the models."""
    rows = []
    for group in groups.values():
        judged = [_all_features(one) for one in group.specimens]
        rows.append(share(group.name, sum(holds is True for holds in judged), sum(h is not None for h in judged)))
    counted = [row for row in rows if row.label != EXCEPTION and row.count]
    whole = share(
        "all but Fig. 9's", round(sum(row.value * row.count for row in counted)), sum(r.count for r in counted)
    )
    verdict = whole.verdict(1, 0.9)
    rule = "three features in more than 9 of 10 specimens; each: Wilson's interval"
    return Finding("The three features are seen in every test but Fig. 9's", "①", rule, [whole, *rows], verdict)


def _all_features(one: Specimen) -> bool | None:
    holds = list(one.holds.values())
    return None if None in holds else all(holds)


def _sharp(groups: Groups, kind: str) -> Finding:
    some = [g for g in groups.values() if g.name.endswith("triple") == (kind == "triple")]
    rows = [mean(group.name, group.values("sharpness")) for group in some]
    whole = _over("all boxes and sizes", some, "sharpness")
    rule = f"greatest τ of the polynomial less than {SHARP} × that of the last fifth"
    return Finding(
        f"Dense specimens have no sharp peak: {kind} discs", "②", rule, [whole, *rows], whole.verdict(-1, SHARP)
    )


def _over(label: str, some: Iterable[Group], name: str) -> Effect:
    """Mean of the models' means."""
    values = [of_model for group in some if len(of_model := group.values(name))]
    return mean_of_groups(f"{label}, {len(values)} models", values)


def _falling(groups: Groups) -> Finding:
    some = [g for g in groups.values() if not g.name.endswith("triple")]
    whole = _over("all boxes and sizes", some, "late_rate")
    rows = [mean(group.name, group.values("late_rate")) for group in some]
    rule = "the lid falls in the second half of the travel, mm/mm"
    return Finding("The dilatancy curve of single discs falls", "③ 1)", rule, [whole, *rows], whole.verdict(-1))


def _pairs(groups: Groups, first: str, second: str) -> list[tuple[str, Group, Group]]:
    names = [(box, f"{box}_{first}", f"{box}_{second}") for box in BOXES]
    return [(box, groups[a], groups[b]) for box, a, b in names if a in groups and b in groups]


def _compared(groups: Groups, first: str, second: str, name: str) -> list[Effect]:
    """The second less the first: in all boxes together, then in each."""
    pairs = [(box, a.linear(name), b.linear(name)) for box, a, b in _pairs(groups, first, second)]
    if not pairs:
        return [unknown(f"{second} less {first}")]
    whole = common_difference(f"{second} less {first}, all boxes", [(a, b) for _, a, b in pairs])
    return [whole, *(difference(f"{second} less {first}, box {box}", a, b) for box, a, b in pairs)]


def _finer(groups: Groups, name: str, claim: str, source: str, sign: int = -1) -> Finding:
    """Both steps, from 4-8 to 2-4 mm and on to 2 mm, must go down (sign -1) or up."""
    steps = [_compared(groups, COARSE, FINE, name), _compared(groups, FINE, FINEST, name)]
    verdicts = [step[0].verdict(sign) for step in steps]
    verdict = next((v for v in (CONTRADICTED, OPEN) if v in verdicts), CONFIRMED)
    rule = f"{'lower' if sign < 0 else 'higher'} at both steps: from 4–8 to 2–4 mm, and from there to 2 mm"
    return Finding(claim, source, rule, [step[0] for step in steps] + steps[0][1:] + steps[1][1:], verdict, len(steps))


def _larger(groups: Groups, name: str, what: str) -> Finding:
    effects = []
    for size in (COARSE, FINE, TRIPLE):
        known = [(box, groups[f"{box}_{size}"]) for box in BOXES if f"{box}_{size}" in groups]
        of_boxes = [(float(np.log2(WIDTHS[box])), group.linear(name)) for box, group in known]
        effects.append(slope(f"{size}, for twice the width", of_boxes))
    rule = "slope over log₂ of the width below 0, of 4–8 mm (the wide distribution)"
    claim = f"With a wide distribution of sizes the larger the box, the lower {what}"
    return Finding(claim, "③ 2)", rule, effects, effects[0].verdict(-1))


_TRIPLE_CLAIMS: list[tuple[str, str, str, int]] = [
    ("phi", "Grains of three discs raise φ (lid)", "④, 3.3", 1),
    ("phi_plane", "Grains of three discs raise φ (shear plane)", "④, 3.3", 1),
    ("dilation_deg", "They dilate more: dilation angle at the peak, degrees", "3.3", 1),
    ("late_rate", "Their dilatancy curve rises: rise of the lid in the second half, mm/mm", "3.3", 1),
    ("trm", "They roll less: TRM at the end", "④, Figs 19, 20", -1),
]


def _triples(groups: Groups) -> list[Finding]:
    """Against single discs of the same size of grain, 4-8 mm, and of the same discs, 2-4 mm; the former decides."""
    found = []
    for name, claim, source, sign in _TRIPLE_CLAIMS:
        alike, same_discs = (_compared(groups, size, TRIPLE, name) for size in (COARSE, FINE))
        rule = f"{'more' if sign > 0 else 'less'} than single discs of the same size of grain"
        effects = [alike[0], same_discs[0], *alike[1:], *same_discs[1:]]
        found.append(Finding(claim, source, rule, effects, alike[0].verdict(sign)))
    return found


def _polynomials(groups: Groups) -> Finding:
    """The same peaks as those of the smoothed data, which take no form of the curve for granted."""
    apart = {}
    for group in groups.values():
        of_specimens = np.array([np.mean([missed(test) for test in one.tests.values()]) for one in group.specimens])
        apart[group.name] = of_specimens[np.isfinite(of_specimens)]
    rows = [mean(name, values) for name, values in apart.items()]
    whole = mean_of_groups("all models", list(apart.values()))
    rule = f"the peak of the polynomial is less than {100 * ALIKE:g} % from that of the smoothed data, in the mean of specimens"
    return Finding("Polynomials find the peak", "5 ④", rule, [whole, *rows], whole.verdict(-1, ALIKE))


def of_the_laws(direct: Groups, incremental: Groups) -> list[Finding]:
    """The same seeds with either law, incremental less direct, of all models and of each. Grains of a seed have the same sizes, but are
    packed with the law as well, so packings differ."""
    names, pairs = [], []
    for name in sorted(direct.keys() & incremental.keys()):
        a, b = ({s.seed: s.mean("roughness") for s in of[name].specimens} for of in (direct, incremental))
        if known := [seed for seed in sorted(a.keys() & b.keys()) if np.isfinite(a[seed] + b[seed])]:
            names.append(name)
            pairs.append([np.array([of[seed] for seed in known]) for of in (a, b)])
    if not pairs:
        return []
    every = [np.concatenate(values) for values in zip(*pairs)]
    rows = [paired("incremental less direct, all models", *every)]
    rows += [paired(f"{name}, incremental less direct", *values) for name, values in zip(names, pairs)]
    claim = "Direct accumulation keeps the skeleton more stable than incremental"
    rule = "scatter of τ around its polynomial, over mean τ, is less; pairs of the same seed"
    return [Finding(claim, "2.1, 5 ①", rule, rows, rows[0].verdict(1))]


def halves_agree(groups: Groups, names: Iterable[str]) -> tuple[int, int]:
    """How often the intervals do what they should: specimens split in two by their seeds, of how many pairs the 95 %
    interval of the difference holds 0, and of how many it was tried. Some 95 % should."""
    agree = tried = 0
    for group in groups.values():
        for name in names:
            values = group.linear(name)
            if len(values) < 4:
                continue
            effect = difference("", values[0::2], values[1::2])
            tried += 1
            agree += effect.low <= 0 <= effect.high
    return agree, tried
