#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Error of the coefficient of restitution against the number of steps a contact lasts: two_discs.csv and two_discs.png.

The error depends on the phase, that is when within a step the discs first touch: the median over 20 phases and the whole
range are shown.
"""

from __future__ import annotations

import re
import statistics
import subprocess
from pathlib import Path

from matplotlib.figure import Figure

HERE = Path(__file__).resolve().parent
ENGINE = HERE.parents[1] / "build" / "lmp_cdem"
STEPS = (10, 20, 40, 80, 160, 320)
PHASES = [(k + 0.5) / 20 for k in range(20)]
STOCK = "stock"  # gran/hooke/history of LAMMPS, stock.in


def error(steps: int, phase: float, law: str) -> float:
    """Error of e, %, from two_discs.in or stock.in."""
    engine, deck = ("lmp", "stock.in") if law == STOCK else (ENGINE, "two_discs.in")
    words = ["-log", "none", "-var", "steps", str(steps), "-var", "phase", str(phase), "-var", "law", law]
    done = subprocess.run([engine, "-in", HERE / deck, *words], capture_output=True, text=True, check=True)
    return float(re.findall(r"^law.* error (\S+) %", done.stdout, re.M)[0])


def main() -> None:
    """Runs all cases, writes the table and the picture."""
    rows = []
    for law in ("direct", "incremental", STOCK):
        for steps in STEPS:
            errors = [error(steps, phase, law) for phase in PHASES]
            rows.append((law, steps, statistics.median(errors), min(errors), max(errors)))
    lines = [f"{law},{steps},{median:.4f},{low:.4f},{high:.4f}" for law, steps, median, low, high in rows]
    header = "law,steps,error_median_percent,error_min_percent,error_max_percent"
    (HERE / "two_discs.csv").write_text("\n".join([header, *lines]) + "\n")
    draw(rows)


def draw(rows: list[tuple[str, int, float, float, float]]) -> None:
    """The largest error over all phases, of the direct law and of stock LAMMPS."""
    figure = Figure(figsize=(5, 4), layout="constrained")
    axes = figure.subplots()
    for law, style, label in (("direct", "o-", "pair_style cdem"), (STOCK, "s--", "gran/hooke/history")):
        worst = [max(-low, high, -high) for name, _, _, low, high in rows if name == law]
        median = [abs(middle) for name, _, middle, _, _ in rows if name == law]
        line = axes.loglog(STEPS, worst, style, label=f"{label}, worst phase")[0]
        axes.loglog(STEPS, median, style, color=line.get_color(), alpha=0.4, label="median phase")
    axes.set(xlabel="steps that a contact lasts", ylabel="error of e (%)", title="restitution, h = 0.215")
    axes.set_xticks(STEPS, [str(n) for n in STEPS])
    axes.minorticks_off()
    axes.set_ylim(bottom=5e-4)  # the decks print 0.001 %
    axes.grid(alpha=0.3)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2, fontsize=8)
    figure.savefig(HERE / "two_discs.png", dpi=120)


if __name__ == "__main__":
    main()
