# SPDX-License-Identifier: GPL-2.0-or-later
"""Making a folder ready for an engine, which goes on from a restart file or begins anew."""

from dataclasses import replace

from ..base.errors import ShearboxError
from ..base.files import DUMPS, SHEAR_TABLE
from ..base.restarts import step_of
from ..base.seals import Seal, look_at
from ..reading.dumps import Dump
from ..reading.readers import cut_rows, read_shear
from .phases import SHEAR, Phase, steps_between_frames


def make_ready(phase: Phase) -> tuple[Phase, list[str]]:
    """The phase as it can be started, going on if it can; and what had to be given up for that.

    Of the restart files that are whole the latest is taken which table and dumps of a shear phase reach, too: a power cut may lose what
    was written to them last. They are cut off behind it, so nothing is in them twice. Without one all is written anew.
    """
    _remove(phase, list(phase.drafts))
    steps, notes = _steps_of_checkpoints(phase)
    for name, step in sorted(steps.items(), key=lambda item: -item[1]):
        try:
            dumps, frame = _reaching(phase, step)
        except ShearboxError as error:
            notes.append(f"{name}, of step {step}, is of no use: {error}")
            continue
        _remove(phase, [other for other in phase.checkpoints if steps.get(other, step + 1) > step])
        phase.unseal()
        if phase.name == SHEAR:
            cut_rows(phase.folder / SHEAR_TABLE, step)
        for dump in dumps:
            dump.cut(frame)
        return replace(phase, variables=phase.variables | {"from": name[-1]}), notes
    _remove(phase, [*phase.checkpoints, phase.product, *phase.frames, phase.restart])
    phase.unseal()
    return phase, notes


def refuse_lost_frames(phase: Phase) -> None:
    """Raise ShearboxError for a test that could go on, had its dumps not been removed: to begin it anew may cost days."""
    lost = [name for name in phase.frames if not (phase.folder / name).exists()]
    states = [name for name in phase.checkpoints if (phase.folder / name).exists()]
    if lost and states:
        raise ShearboxError(
            f"{phase.folder}: {', '.join(lost)} of a test that is not finished are gone, and it cannot go on without. Put back a "
            f"copy of them; or, for the test to begin anew, remove {', '.join(states)}"
        )


def _steps_of_checkpoints(phase: Phase) -> tuple[dict[str, int], list[str]]:
    """Of those that are whole, by name; and what is wrong with the others."""
    steps, notes = {}, []
    for name in phase.checkpoints:
        path = phase.folder / name
        step = step_of(path)
        if step is not None and look_at(path) is not Seal.ALTERED:
            steps[name] = step
        elif path.exists():
            notes.append(f"{name} is damaged or half written")
    return steps, notes


def _reaching(phase: Phase, step: int) -> tuple[list[Dump], int]:
    """The dumps, and the step of their last frame up to a step that they and the table reach without a gap; packing and
    consolidation write neither on their way."""
    if phase.name != SHEAR:
        return [], 0
    table = phase.folder / SHEAR_TABLE
    rows = [int(row) for row in read_shear(table)["step"]]
    if step not in rows:
        raise ShearboxError(f"{table} has no row of that step")
    every = steps_between_frames(phase.variables, rows[0])
    frames = list(range(0, step + 1, every))
    dumps = [Dump(phase.folder / name) for name in DUMPS]
    for dump in dumps:
        if [frame for frame in dump.steps if frame <= step] != frames:
            raise ShearboxError(f"{dump.path} lacks frames before that step")
    return dumps, frames[-1]


def _remove(phase: Phase, names: list[str]) -> None:
    for name in names:
        (phase.folder / name).unlink(missing_ok=True)
