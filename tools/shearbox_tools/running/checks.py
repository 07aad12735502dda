# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a request can be carried out as it was given, before anything starts."""

import math
from collections.abc import Mapping

from ..asking.hosts import HOSTS
from ..asking.models import PARAMETERS, Model, read_variables
from ..asking.parameters import canonical, parameters
from ..asking.request import OWN_OPTION, Request
from ..base.errors import InputError
from ..base.files import SHEAR_TABLE
from ..base.numerals import number
from ..base.presets import STRESSES
from .forecast import time_step
from .phases import frames_of, rows_of_shear

# A packed specimen, in half heights: the lid stays in the upper half, and the grains fit into the loose column.
LOWEST, HIGHEST = 1.2, 2.4
MOST_STEPS = 2**31 - 1


def check(request: Request) -> None:
    """Refuse values that cannot be meant; all of them are named at once."""
    of_decks = [*_deck_problems(request.settings), *_model_problems(request.model)]
    problems = [*of_decks, *_stress_problems(request.stresses), *_option_problems(request), *_host_problems(request)]
    if not of_decks:
        problems += _shear_problems(request)
    if problems:
        raise InputError("\n".join(problems))


def _deck_problems(settings: dict[str, str]) -> list[str]:
    """Values of parameters.in, or in their place of the command line, that are out of their range."""
    known = parameters()
    values = {
        name: (str(PARAMETERS), parameter.value) for name, parameter in known.items() if parameter.value is not None
    }
    values |= {name: ("--set", value) for name, value in settings.items()}
    return [f"{where}: {problem}" for name, (where, value) in values.items() if (problem := known[name].problem(value))]


def _option_problems(request: Request) -> list[str]:
    known = parameters()
    problems = []
    for name, option in OWN_OPTION.items():
        if problem := known[name].problem(getattr(request, name)):
            problems.append(problem.replace(name, option, 1))
    for name in ("speed", "travel", "stiffness"):
        problems += _digit_problems(f"--{name}", getattr(request, name))
    return problems


def _host_problems(request: Request) -> list[str]:
    """Values of variables that the host's decks do not have."""
    there = read_variables(PARAMETERS) | {"shape": request.model.shape} | request.settings
    return [
        f"--host {request.host}: {name} is {there[name]}; only {name}={value} is possible there"
        for name, value in HOSTS[request.host].fixed.items()
        if canonical(there[name]) != canonical(value)
    ]


def _model_problems(model: Model) -> list[str]:
    """Variables that are out of their range, or without effect; and a number of grains that does not fill the box. What a model
    has beside its name was made of these numbers: if they are wrong, nothing more is told of it."""
    numbers = {name: value for name, value in model.variables.items() if name not in model.further}
    problems = _variable_problems(numbers) or _size_problems(model)
    if not (problems and model.text):
        problems += _variable_problems(model.further)
    where = f"model {model.name}" if model.text else model.path
    return [f"{where}: {problem}" for problem in problems]


def _variable_problems(variables: Mapping[str, float | str]) -> list[str]:
    known = {name: parameter for name, parameter in parameters().items() if parameter.value is None}
    problems = []
    for name, value in variables.items():
        if name not in known:
            problems.append(f"{name} is no variable of a model; these are {', '.join(known)}")
        elif problem := known[name].problem(value):
            problems.append(problem)
    return problems


def _size_problems(model: Model) -> list[str]:
    if model.dmin > model.dmax:
        return [f"dmin {model.dmin:g} is more than dmax {model.dmax:g}"]
    if LOWEST <= model.half_heights <= HIGHEST:
        return []
    low, high = (math.ceil(model.ngrains * share / model.half_heights) for share in (LOWEST, HIGHEST))
    return [
        f"ngrains {model.ngrains}: about {low} to {high} are expected; {model.ngrains} of these grains "
        f"would be {model.half_heights:.2g} times as high as one half of the box"
    ]


def _stress_problems(stresses: tuple[float, ...]) -> list[str]:
    problems = []
    for stress in stresses:
        what = f"--stress {stress:g}"
        if not math.isfinite(stress) or stress <= 0:
            problems.append(f"{what}: a stress above 0 kPa is expected")
        elif stress > STRESSES[1]:
            problems.append(
                f"{what}: kPa are expected, at most {STRESSES[1]}; {stress:g} Pa would be {stress / 1000:g}"
            )
        elif stress < STRESSES[0]:
            problems.append(
                f"{what}: kPa are expected, at least {STRESSES[0]}; {stress:g} MPa would be {stress * 1000:g}"
            )
        else:
            problems += _digit_problems("--stress", stress)
    if len({f"{stress:g}" for stress in stresses}) < len(stresses):
        problems.append(f"--stress {' '.join(f'{s:g}' for s in stresses)}: a stress is named twice")
    return problems


def _digit_problems(option: str, value: float) -> list[str]:
    """The decks, and the names of folders, have six digits."""
    if not math.isfinite(value) or float(f"{value:g}") == value:
        return []
    return [f"{option} {value!r}: at most six digits are expected, such as {value:g}"]


def _step_problems(request: Request) -> list[str]:
    """LAMMPS counts the steps of a run with 32 bits."""
    if _option_problems(request) or not (request.travel > 0 and request.speed > 0):
        return []
    steps = request.travel / request.speed / time_step(request)
    if steps < MOST_STEPS:
        return []
    return [
        f"--travel {request.travel:g} --speed {request.speed:g}: some {steps:.2g} steps; at most {MOST_STEPS:.3g} are expected: "
        f"shear by less, or faster than {request.speed * steps / MOST_STEPS:.2g} mm/s"
    ]


def _shear_problems(request: Request) -> list[str]:
    problems = _step_problems(request)
    width = request.model.width * 1000
    share = number({**read_variables(PARAMETERS), **request.settings}["flanges"])
    if not 0.001 <= request.speed <= 1000:
        hint = f"; {request.speed:g} m/s would be {request.speed * 1000:g}" if 1e-6 <= request.speed < 0.001 else ""
        problems.append(f"--speed {request.speed:g}: 0.001 to 1000 mm/s are expected{hint}")
    if not 0.1 <= request.travel <= share * width:
        hint = f"; {request.travel:g} m would be {request.travel * 1000:g}" if 1e-4 <= request.travel < 0.1 else ""
        problems.append(
            f"--travel {request.travel:g}: 0.1 to {share * width:g} mm, {share:g} of the box's width, "
            f"are expected{hint}"
        )
    rows, frames = rows_of_shear(), frames_of(request.settings)
    if rows % frames:
        near = [
            max(n for n in range(1, frames) if rows % n == 0),
            min(n for n in range(frames, rows + 1) if rows % n == 0),
        ]
        problems.append(
            f"--set frames={frames}: a number that divides the {rows} rows of {SHEAR_TABLE} is expected, such as "
            f"{near[0]} or {near[1]}; else no frame would be of the end of the test"
        )
    return problems
