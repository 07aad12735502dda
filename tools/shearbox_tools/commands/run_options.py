# SPDX-License-Identifier: GPL-2.0-or-later
"""The options that `shearbox run` and `shearbox submit` share, and what they ask for."""

import argparse
from pathlib import Path
from typing import Any

from ..base.errors import InputError
from ..base.presets import DENSITIES, HOSTS, LAWS, PACKING_FRICTION, REFERENCE, SPEEDS


def add_what_to_run(run: argparse.ArgumentParser) -> None:
    """All of them."""
    _add_options_of_a_run(run)
    run.add_argument("--out", metavar="DIR", type=Path, help="folder of the results; needed unless MODEL is one")
    run.add_argument(
        "--jobs",
        metavar="N",
        type=int,
        help="phases run at the same time, of all stresses and specimens (default: 2; of 'submit': those of a job, as many "
        "as a node has cores for, else one for each stress)",
    )
    run.add_argument("--only", metavar="NAME", nargs="+", action="extend", help="of a campaign file: these runs alone")
    run.add_argument("--ranks", metavar="N", type=int, default=1, help="MPI ranks of each phase (default: 1)")
    run.add_argument(
        "--engine", metavar="FILE", type=Path, help="engine (default: lmp_cdem of this Shearbox, or liggghts)"
    )
    run.add_argument("--dry-run", action="store_true", default=False,
                     help="only say what would run, about how long, and how much it would write; of 'submit': the scripts")  # fmt: skip


def _add_options_of_a_run(run: argparse.ArgumentParser) -> None:
    """Those that a campaign file may have, too."""
    model = run.add_argument("model", metavar="MODEL",
                     help="name of a model, as 'shearbox models' lists them, or of any other box, as 'shearbox model --help' has "
                     "them; or the path of a model file, NAME.in; or the folder of earlier runs, which go on as they were asked "
                     "for; or a campaign file, NAME.toml, that asks for many runs, as those of tools/paper_tools/campaigns")  # fmt: skip
    _complete(model)
    run.add_argument("--stress", metavar="KPA", type=stress, nargs="+", action="extend",
                     help="normal stresses, kPa (default: 100 200 300 400)")  # fmt: skip
    pace = run.add_mutually_exclusive_group()
    pace.add_argument("--accuracy", choices=list(SPEEDS),
                      help="chooses --speed: " + ", ".join(f"{name} {v:g} mm/s" for name, v in SPEEDS.items())
                      + f" (default: {REFERENCE})")  # fmt: skip
    pace.add_argument("--speed", metavar="V", type=float, help="shear speed, mm/s (default: that of --accuracy)")
    run.add_argument(
        "--travel",
        metavar="S",
        type=float,
        help="shear displacement at the end, mm (default: 8); to go on further later is not possible",
    )
    run.add_argument("--seed", metavar="N", type=int, help="seed of the packing (default: 1)")
    run.add_argument("--seeds", metavar="N", type=_seeds, nargs="+", action="extend",
                     help="several specimens: one number is how many, with seeds from 1 on; several, or ranges such as 4-8, are "
                     "their seeds. Each is a run of its own, in DIR/seed_N")  # fmt: skip
    run.add_argument("--independent", action="store_true",
                     help="with --seeds: a packing of its own for each stress, in DIR/seed_N_KPAkPa; its seed is 1000000 N + "
                     "100 KPA")  # fmt: skip
    run.add_argument("--density", choices=list(DENSITIES),
                     help=f"chooses {PACKING_FRICTION}, the friction angle while grains are packed: "
                     + ", ".join(f"{name} {angle:g}°" for name, angle in DENSITIES.items()) + " (default: dense)")  # fmt: skip
    run.add_argument("--host", choices=HOSTS,
                     help=f"program that carries the tests out (default: {HOSTS[0]}); LIGGGHTS has discs only, as grains and as "
                     "sides, so --set sides=discs is needed, and writes no frames")  # fmt: skip
    run.add_argument("--law", choices=LAWS, help=f"contact law (default: {LAWS[0]})")
    run.add_argument("--dt", metavar="DT",
                     help="time step, s (default: auto, from the stability limit of the contacts)")  # fmt: skip
    run.add_argument("--stiffness", metavar="F", type=float,
                     help="factor on the stiffness of all contacts: less gives larger overlaps and time steps (default: 1)")  # fmt: skip
    run.add_argument("--set", metavar="NAME=VALUE", nargs="+", action="extend",
                     help="another value for a variable of the decks or of the model, such as phi=30; "
                     "'shearbox parameters' lists them")  # fmt: skip


def stress(text: str) -> float:
    """kPa."""
    try:
        return float(text)
    except ValueError:
        hint = " Between stresses are blanks: --stress 100 200" if "," in text else ""
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of kPa.{hint}") from None


def _seeds(text: str) -> int | range:
    first, dash, last = text.partition("-")
    try:
        return range(int(first), int(last) + 1) if first and dash else int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: a number, or a range such as 4-8, is expected") from None


def _complete(argument: argparse.Action) -> None:
    """Let shells offer the names of models and folders for it."""

    def names(prefix: str, **_: Any) -> list[str]:
        from argcomplete.completers import FilesCompleter

        from ..asking.models import model_files

        known = [file.stem for file in model_files()]
        return [*(name for name in known if name.startswith(prefix)), *FilesCompleter()(prefix)]

    setattr(argument, "completer", names)  # where argcomplete looks for it


def parse_run(words: list[str]) -> tuple[argparse.Namespace, list[dict[str, Any]]]:
    """A command line of `run` without the command, and what it asks for."""
    from .campaign_file import OptionParser

    parser = OptionParser(prog="run", add_help=False, allow_abbrev=False, argument_default=argparse.SUPPRESS)
    add_what_to_run(parser)
    options = parser.parse_args(words)
    return options, asked_by(options)


def asked_by(options: argparse.Namespace) -> list[dict[str, Any]]:
    """What is asked for, of each run or ensemble."""
    from .campaign_file import OptionParser, is_campaign, read_campaign

    if not is_campaign(options.model):
        if "only" in options:
            raise InputError(f"--only: it is for campaign files, {options.model} is none")
        return [_with_speed(options)]
    parser = OptionParser(add_help=False, allow_abbrev=False, argument_default=argparse.SUPPRESS)
    _add_options_of_a_run(parser)
    names = [option.dest for option in parser._actions]  # argparse has no public name for it
    return read_campaign(
        Path(options.model), names, lambda words: _with_speed(parser.parse_args(words)), _with_speed(options)
    )


def _with_speed(options: argparse.Namespace) -> dict[str, Any]:
    """As --accuracy chooses it."""
    of_accuracy = {"speed": SPEEDS[options.accuracy]} if "accuracy" in options else {}
    return of_accuracy | vars(options)
