# SPDX-License-Identifier: GPL-2.0-or-later
"""The time of a step on many ranks, from what was counted and from a network's latency and bandwidth.

A rank with n discs takes

    T(n, ranks) = n t + m a + (b sqrt(n) + b0) / B + r a log2(ranks)

t: time of a disc and step, of 1e5 discs on one rank in tests/benchmarks; m: messages; b sqrt(n) + b0: bytes, whose number grows with the length
of the rank's border; r: reductions, which take log2(ranks) stages of a message each (recursive doubling; Thakur,
Rabenseifner, Gropp, Int. J. High Perform. Comput. Appl. 19 (2005) 49). a: latency, B: bandwidth of the network. Nothing is
overlapped, and no rank waits for another one that has more to do. The efficiency is n t / T.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from scipy.optimize import brentq  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import table  # noqa: E402

DISC = 16e-9  # s
LATENCY, BANDWIDTH = 1.5e-6, 10e9  # s, bytes/s: of an InfiniBand network, between nodes
RANKS = (16, 64, 256, 1024, 4096)
GRAINS = (9_000, 36_000, 144_000, 1_000_000, 10_000_000)
WORTH = 0.75  # twice the ranks pay if a step then takes at most so much of its time
LOOKS = dict(
    zip(RANKS, (("#1f4fd8", "-"), ("#d62728", "--"), ("#1a9641", "-."), ("#111111", ":"), ("#e08214", (0, (6, 1)))))
)


@dataclass(frozen=True)
class Cost:
    """What a step costs; counts are of the rank that sends most."""

    messages: float
    of_border: float  # bytes over the root of the discs of a rank
    fixed: float  # bytes
    reductions: float

    def seconds(self, discs: float, ranks: float) -> float:
        """Of a step, with so many discs on each rank."""
        sent = self.of_border * np.sqrt(discs) + self.fixed
        waits = self.messages * LATENCY + sent / BANDWIDTH + self.reductions * LATENCY * np.log2(ranks)
        return float(discs * DISC + waits)

    def efficiency(self, discs: float, ranks: float) -> float:
        """Time of the discs alone over that of the step."""
        return discs * DISC / self.seconds(discs, ranks)

    def discs_for(self, efficiency: float, ranks: float) -> float:
        """Discs that a rank must have."""
        return float(brentq(lambda n: self.efficiency(n, ranks) - efficiency, 1, 1e9))

    def most_ranks(self, discs: float) -> int:
        """Powers of two up to which twice the ranks pay."""
        ranks = 1
        while self.seconds(discs / (2 * ranks), 2 * ranks) <= WORTH * self.seconds(discs / ranks, ranks):
            ranks *= 2
        return ranks


def cost(counted: dict[str, Any]) -> Cost:
    """Of ranks that have neighbours on all sides, from 32 on in a box that is wider than high."""
    inner = {int(ranks): counts for ranks, counts in counted["ranks"].items() if int(ranks) >= 32}
    root = np.sqrt([counted["discs"] / ranks for ranks in inner])
    slope, fixed = np.polyfit(root, [counts["bytes"] for counts in inner.values()], 1)
    return Cost(
        max(counts["messages"] for counts in inner.values()),
        float(slope),
        float(fixed),
        max(counts["reductions"] for counts in inner.values()),
    )


def publish(counted: dict[str, Any], out: Path) -> str:
    """Writes tables.md and ranks.svg; the tables."""
    of = cost(counted)
    text = f"{counted['model']}: what the rank that sends most sends in a step of the shear test.\n\n"
    rows = []
    for ranks, counts in counted["ranks"].items():
        numbers = [f"{counts[name]:.4g}" for name in ("messages", "bytes", "reductions", "bytes_reduced")]
        rows.append([ranks, f"{counted['discs'] / int(ranks):.0f}", *numbers])
    text += table(["ranks", "discs a rank", "messages", "bytes", "reductions", "bytes in them"], rows)
    text += (
        f"\n\nModel: {1e9 * DISC:g} ns a disc, {of.messages:.3g} messages, {of.of_border:.0f} √n + {of.fixed:.0f} bytes, "
        f"{of.reductions:.3g} reductions; network: {1e6 * LATENCY:g} µs, {BANDWIDTH / 1e9:g} GB/s. Efficiency of the ranks:\n\n"
    )
    rows = []
    for grains in GRAINS:
        shares = [f"{of.efficiency(grains / ranks, ranks):.2f}" for ranks in RANKS]
        rows.append([f"{grains}", *shares, f"{of.most_ranks(grains)}"])
    needed = [f"{of.discs_for(share, ranks):.0f}" for share in (0.5, 0.9) for ranks in RANKS]
    rows += [["discs a rank for 0.5", *needed[: len(RANKS)], ""], ["for 0.9", *needed[len(RANKS) :], ""]]
    text += table(["grains", *(f"{ranks} ranks" for ranks in RANKS), "twice the ranks pay up to"], rows) + "\n"
    (out / "tables.md").write_text(text)
    draw(of, out / "ranks.svg")
    return text


def draw(of: Cost, file: Path) -> None:
    """Efficiency against the discs of a rank."""
    figure, panel = plt.subplots(figsize=(5.2, 3.4), layout="constrained")
    discs = np.geomspace(30, 3e5, 200)
    for ranks, (colour, dashes) in LOOKS.items():
        panel.semilogx(discs, [of.efficiency(n, ranks) for n in discs], color=colour, ls=dashes, label=f"{ranks} ranks")
    for share in (0.5, 0.9):
        panel.axhline(share, color="#c9ced4", lw=0.8, zorder=0)
    panel.set(xlabel="discs on a rank", ylabel="efficiency (model)", ylim=(0, 1))
    panel.legend(frameon=False)
    figure.savefig(file, metadata={"Date": None})
    plt.close(figure)
