#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Stands in for lmp_cdem: takes its command line and writes what the decks write, with known curves.

FAKE_SECONDS: how long a shear phase takes that begins anew; FAKE_FAIL: end of the folder of a phase that fails half way
('200', 'packed', 'seed_2/packed');
FAKE_DIARY: file that gets a line when an engine starts, and from which restart file, and ends.
"""

import os
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
import synthetic  # noqa: E402  its own imports need the path of the tools
from shearbox_tools.base.files import DUMPS  # noqa: E402
from shearbox_tools.base.restarts import step_of  # noqa: E402
from shearbox_tools.running.phases import rows_of_shear, steps_between_frames  # noqa: E402

ROWS = rows_of_shear()
ROWS_PER_FRAME = steps_between_frames({}, 1)
ROWS_PER_RESTART = ROWS // 50


def main() -> int:
    words = sys.argv[1:]
    variables = {words[i + 1]: words[i + 2] for i, word in enumerate(words) if word == "-var"}
    phase = Path(words[words.index("-in") + 1]).stem
    log = Path(words[words.index("-log") + 1])
    log.write_text("LAMMPS (29 Sep 2021)\nShearbox 0.1.0 (fake)\n", encoding="utf-8")
    diary("start", phase, variables.get("from", ""))
    {"pack": pack, "consolidate": consolidate, "shear": shear}[phase](variables, log)
    diary("end", phase)
    with log.open("a", encoding="utf-8") as stream:
        stream.write("Loop time of 2 on 1 procs for 1000 steps with 350 atoms\n")
        stream.write("Pair    | 1.5        | 1.5        | 1.5        |   0.0 | 75.00\n")
        stream.write("Other   |            | 0.5        |            |       | 25.00\n")
        stream.write("Total wall time: 0:00:01\n")
    return 0


def pack(_: dict[str, str], log: Path) -> None:
    fail_if_asked(log)
    bed("packed")


def consolidate(variables: dict[str, str], _: Path) -> None:
    assert Path(variables["packed"]).exists(), "the packing is not there"
    bed("consolidated", sigma_kPa=float(variables["sigma"]))


def shear(variables: dict[str, str], log: Path) -> None:
    travel, sigma = float(variables["travel"]), float(variables["sigma"])
    columns = synthetic.curves(sigma, travel, ROWS, int(variables["seed"]))
    columns |= synthetic.inside(columns, sigma)
    table = Path("shear.dat")
    begin = 0
    if "from" in variables:
        step = step_of(Path(f"shear.restart.{variables['from']}"))
        assert step is not None
        begin = step // synthetic.STEPS_PER_ROW
    else:
        synthetic.write_shear(table, columns, slice(0, 0))
        synthetic.write_frames(Path(), [0], travel)
    frames = {name: Path(name).read_text(encoding="utf-8") for name in DUMPS}
    asked: list[int] = []
    signal.signal(signal.SIGUSR1, lambda *_: asked.append(1))
    with log.open("a", encoding="utf-8") as stream:
        stream.write("compute     asked all cdem/signal\n")
    first = {name: text[: text.find("ITEM: TIMESTEP", 1) if begin else None] for name, text in frames.items()}
    for row in range(begin, ROWS):
        if row == ROWS // 2:
            fail_if_asked(log)
        step = (row + 1) * synthetic.STEPS_PER_ROW
        synthetic.write_shear(table, columns, slice(row, row + 1), "a")
        if (row + 1) % ROWS_PER_FRAME == 0:
            for name, text in first.items():
                with Path(name).open("a", encoding="utf-8") as stream:
                    stream.write(text.replace("TIMESTEP\n0\n", f"TIMESTEP\n{step}\n"))
        if (row + 1) % ROWS_PER_RESTART == 0:
            synthetic.write_restart(Path("shear.restart." + "ab"[(row + 1) // ROWS_PER_RESTART % 2]), step)
        if asked:
            synthetic.write_restart(Path("shear.restart.c"), step)
            sys.exit(0)
        if not begin and "FAKE_SECONDS" in os.environ:
            time.sleep(float(os.environ["FAKE_SECONDS"]) / ROWS)
    synthetic.write_restart(Path("sheared.restart"), ROWS * synthetic.STEPS_PER_ROW)
    for path in Path().glob("shear.restart.?"):
        path.unlink()


def bed(name: str, **more: float) -> None:
    synthetic.write_row(
        Path(f"{name}.csv"), grains=synthetic.GRAINS, height_m=0.0987, solid_fraction=0.835,
        solid_fraction_bottom=0.834, solid_fraction_top=0.836, unbalanced=8e-5, kinetic_J=3e-12, steps=123000, **more,
    )  # fmt: skip
    synthetic.write_restart(Path(f"{name}.restart"), 123000)


def fail_if_asked(log: Path) -> None:
    if Path.cwd().match(os.environ.get("FAKE_FAIL", "nothing")):
        with log.open("a", encoding="utf-8") as stream:
            stream.write("ERROR: Lost atoms: original 350 current 349 (src/thermo.cpp:439)\nLast command: run 100\n")
        sys.exit(1)


def place() -> str:
    """The folder of the phase, with that of its specimen if it is one of several."""
    folder = Path.cwd()
    return f"{folder.parent.name}/{folder.name}" if folder.parent.name.startswith("seed_") else folder.name


def diary(event: str, phase: str, restart: str = "") -> None:
    if "FAKE_DIARY" in os.environ:
        with open(os.environ["FAKE_DIARY"], "a", encoding="utf-8") as stream:
            stream.write(f"{event} {phase} {place()} {restart}".rstrip() + "\n")


if __name__ == "__main__":
    sys.exit(main())
