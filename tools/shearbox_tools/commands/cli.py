# SPDX-License-Identifier: GPL-2.0-or-later
"""The command line of `shearbox`."""

import argparse
import importlib.util
import io
import os
import shlex
import signal
import sys
from pathlib import Path
from types import FrameType
from typing import Any, NoReturn

from .. import __version__
from ..base.errors import InputError, ShearboxError
from ..base.presets import COLOURINGS, DENSITIES, FILMS, FORM, FORMATS
from .run_options import add_what_to_run, asked_by, stress

Commands = argparse._SubParsersAction  # argparse has no public name for it
DEPENDENCIES = {"numpy": "python3-numpy", "scipy": "python3-scipy", "matplotlib": "python3-matplotlib",
                "jinja2": "python3-jinja2", "rich": "python3-rich"}  # fmt: skip


class Parser(argparse.ArgumentParser):
    """Says what is wrong without a usage of many lines before it."""

    def error(self, message: str) -> NoReturn:
        """Of what was given."""
        self.exit(2, f"shearbox: {message}\nSee '{self.prog} --help'\n")


def main(arguments: list[str] | None = None) -> int:
    """Run one command; the exit status is 0, 1 (failed), 2 (bad input) or 128 + signal (stopped)."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # Latin-1 has no greek letters, and a stranger's path may have any
    parser = make_parser()
    if "_ARGCOMPLETE" in os.environ:  # a shell asks what may follow (README)
        import argcomplete

        argcomplete.autocomplete(parser)
    options = parser.parse_args(arguments)
    # matrices are so small here that threads only wait for each other, on a busy machine for most of the time
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    for sign in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(sign) != signal.SIG_IGN:  # as nohup leaves it
            signal.signal(sign, _interrupt)
    try:
        _check_dependencies()
        options.command(options)
        return 0
    except ShearboxError as error:
        print(f"shearbox: {error}", file=sys.stderr)
        return error.code
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # the reader left: nobody to tell
        return 1
    except OSError as error:  # disk full, no more memory or processes, ...
        print(f"shearbox: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt as interruption:
        print(f"shearbox: {_how_to_go_on(options)}", file=sys.stderr)
        return 128 + (interruption.args[0] if interruption.args else signal.SIGINT)


def make_parser() -> argparse.ArgumentParser:
    """All commands and options, with units."""
    parser = Parser(prog="shearbox", description="The 2D direct shear test of sand by the distinct element method.")
    parser.add_argument("--version", action="version", version=f"shearbox {__version__}")
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    _add_models(commands)
    _add_model(commands)
    _add_parameters(commands)
    _add_run(commands)
    _add_report(commands)
    _add_compare(commands)
    _add_export(commands)
    _add_film(commands)
    _add_submit(commands)
    _add_jobs(commands)
    return parser


def _add_json(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="print it as JSON, for scripts")


def _add_models(commands: Commands) -> None:
    models = commands.add_parser("models", help="list the models", description="The models of the paper's Table 1.")
    _add_json(models)
    models.set_defaults(command=_models)


def _add_model(commands: Commands) -> None:
    model = commands.add_parser(
        "model",
        help="print the file of a model that is made of its name",
        description="The file of a model of any box, for the decks: 'shearbox model NAME > NAME.in', then '-var models . -var "
        "model NAME'. 'shearbox run NAME' makes it by itself.",
    )
    model.add_argument("name", metavar="NAME", help=FORM)
    model.add_argument("--density", choices=list(DENSITIES), default="dense", help="of the packing, for COUNT auto")
    model.set_defaults(command=_model)


def _add_parameters(commands: Commands) -> None:
    parameters = commands.add_parser(
        "parameters",
        help="list what --set can set",
        description="The variables of the decks that 'shearbox run --set NAME=VALUE' can set: value, range, meaning with unit.",
    )
    _add_json(parameters)
    parameters.set_defaults(command=_parameters)


def _add_run(commands: Commands) -> None:
    run = commands.add_parser(
        "run",
        help="run a model and report on it",
        description="Pack a model once, consolidate and shear it at each stress, and write the report. "
        "Run again with the same DIR, it goes on where it stopped; further stresses may be added later.",
        argument_default=argparse.SUPPRESS,  # so that 'run DIR' knows what was given
    )
    add_what_to_run(run)
    run.set_defaults(command=_run, jobs=2)


def _named_folder(text: str) -> Path:
    """Reports and films call runs by the names of their folders, which . and .. have not."""
    folder = Path(text)
    return folder if folder.name not in ("", "..") else folder.resolve()


def _speed(text: str) -> float:
    try:
        speed = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of mm/s") from None
    if not 0.001 <= speed <= 1000:
        raise argparse.ArgumentTypeError(f"{text}: 0.001 to 1000 mm/s are expected")
    return speed


def _add_report(commands: Commands) -> None:
    report = commands.add_parser(
        "report",
        help="analyse a folder of results",
        description="Analyse the results in DIR, also incomplete ones: writes summary.json, STRESS/curve.csv and "
        "report.html, which opens in any browser without a network. Of a folder of several runs, wherever they are in it: "
        "those that differ only in seed and stresses are an ensemble, with mean curves in curves.csv; each run has its own "
        "report, too. Tests that were run with the decks by hand are folders with a shear.dat, and the engine's log beside it.",
    )
    report.add_argument(
        "folder", metavar="DIR", type=_named_folder, help="folder given to 'shearbox run --out', or above several"
    )
    report.add_argument(
        "--model", metavar="MODEL", help="of tests run by hand whose log is lost: name or file of the model"
    )
    report.add_argument(
        "--speed", metavar="V", type=_speed, help="of tests run by hand, where no log tells it: shear speed, mm/s"
    )
    report.set_defaults(command=_report)


def _add_compare(commands: Commands) -> None:
    compare = commands.add_parser(
        "compare",
        help="compare ensembles",
        description="Write compare.html, compare.json and compare.csv: mean curves of the ensembles in the folders over each other, "
        "strength, dilation angle and TRM, and their differences to the first with 95 % intervals.",
    )
    compare.add_argument("folders", metavar="DIR", type=_named_folder, nargs="+", help="folder of a run, or of several")
    compare.add_argument(
        "--out", metavar="OUT", type=Path, default=Path("compare"), help="folder of the files (default: compare)"
    )
    compare.set_defaults(command=_compare)


def _add_export(commands: Commands) -> None:
    export = commands.add_parser(
        "export",
        help="write frames for ParaView, OVITO, pandas and others",
        description="Write grains, discs, walls, contacts and cells of the frames of all tests in DIR: a file each and frame, "
        "and their times in frames.csv. Those of an earlier export are replaced. vtk: VTK's XML files, and a series NAME.pvd "
        "that ParaView opens; ovito: dumps with an id for each disc, the same in all frames, and contacts with vectors; csv; "
        "parquet. SI units.",
    )
    export.add_argument("folder", metavar="DIR", type=_named_folder, help="folder of runs, or of tests by hand")
    export.add_argument("--to", choices=FORMATS, required=True, help="format")
    export.add_argument("--out", metavar="OUT", type=Path, help="folder of the files (default: DIR/export)")
    _add_stress_and_frames(export)
    export.set_defaults(command=_export)


def _add_stress_and_frames(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--stress", metavar="KPA", type=stress, nargs="+", action="extend", default=[],
                        help="normal stresses, kPa (default: all there are)")  # fmt: skip
    parser.add_argument("--frames", metavar="FRAMES",
                        help="number of a frame, or FROM:TO:EVERY, TO left out; -1 is the last (default: all)")  # fmt: skip


def _add_film(commands: Commands) -> None:
    film = commands.add_parser(
        "film",
        help="make films of the specimens",
        description="Make a film of each test in DIR: the specimen to scale, and shear stress and lid as far as they have come. "
        "It is STRESS/film.FORMAT, or film_speed.FORMAT and so on.",
    )
    film.add_argument("folder", metavar="DIR", type=_named_folder, help="folder of runs, or of tests by hand")
    film.add_argument("--by", choices=COLOURINGS, default=COLOURINGS[0],
                      help="what grains are coloured by; chains: lines as wide as forces are great (default: rotation)")  # fmt: skip
    film.add_argument("--format", choices=FILMS,
                      help="mp4 (H.264) and webm need ffmpeg, gif does not (default: mp4, or gif where there is no ffmpeg)")  # fmt: skip
    _add_stress_and_frames(film)
    film.set_defaults(command=_film)


def _add_submit(commands: Commands) -> None:
    submit = commands.add_parser(
        "submit",
        help="run on a cluster",
        description="Submit what 'shearbox run' with the same options would do to the batch system of a cluster: an array of "
        "jobs for all tests, and the report after them. A job ends before its limit and begins again, to go on; one that "
        "fails does not touch the others. Given again, it submits what is left.",
        argument_default=argparse.SUPPRESS,
    )
    add_what_to_run(submit)
    submit.add_argument("--cluster", metavar="FILE", type=Path,
                        help="what jobs of the cluster need, see examples/cluster (default: ~/.config/shearbox/cluster.toml, "
                        "if there is one)")  # fmt: skip
    submit.set_defaults(command=_submit)


def _add_jobs(commands: Commands) -> None:
    for name, command, what in (
        ("status", _status, "say what the jobs of a folder are doing"),
        ("cancel", _cancel, "end the jobs of a folder"),
        ("element", _element, "carry out a part of what was submitted: for the scripts of jobs"),
    ):
        listed: dict[str, Any] = {} if command is _element else {"help": what}  # that one is not for people
        parser = commands.add_parser(name, description=f"{what[0].upper()}{what[1:]}.", **listed)
        parser.add_argument("folder", metavar="DIR", type=Path, help="folder given to 'shearbox submit --out'")
        parser.set_defaults(command=command)
        if command is _status:
            _add_json(parser)
        if command is _element:
            parser.add_argument("number", metavar="N", type=int, help="number of the element, from 1 on")


# The commands import what they need themselves: --help answers at once, and a missing package has a message.


def _models(options: argparse.Namespace) -> None:
    from .listing import print_models

    print_models(options.json)


def _model(options: argparse.Namespace) -> None:
    from ..asking.named import model_text

    text = model_text(options.name, DENSITIES[options.density])
    if text is None:
        raise InputError(f"no model can be made of '{options.name}'. Names are {FORM}")
    print(text, end="")


def _parameters(options: argparse.Namespace) -> None:
    from .listing import print_parameters

    print_parameters(options.json)


def _run(options: argparse.Namespace) -> None:
    from .run import run

    run(options, asked_by(options))


def _report(options: argparse.Namespace) -> None:
    from ..reports.report_on import report_on

    print(f"report: {report_on(options.folder, options.model, options.speed)}")


def _compare(options: argparse.Namespace) -> None:
    from ..reports.comparing import compare

    page, doubts = compare(options.folders, options.out)
    for doubt in doubts:
        print(f"no φ and c of {doubt}")
    print(f"compare: {page}")


def _export(options: argparse.Namespace) -> None:
    from ..frames.export import export

    for folder in export(options.folder, options.to, options.out, options.stress, options.frames):
        print(f"export: {folder}")


def _film(options: argparse.Namespace) -> None:
    from ..frames.filming import make_films

    for path in make_films(options.folder, options.by, options.format, options.stress, options.frames):
        print(f"film: {path}")


def _submit(options: argparse.Namespace) -> None:
    from .submit import submit

    submit(options, asked_by(options))


def _status(options: argparse.Namespace) -> None:
    from .status import status

    status(options.folder, options.json)


def _cancel(options: argparse.Namespace) -> None:
    from .status import cancel

    cancel(options.folder)


def _element(options: argparse.Namespace) -> None:
    from .submit import element

    element(options.folder, options.number)


def _check_dependencies() -> None:
    missing = [package for module, package in DEPENDENCIES.items() if importlib.util.find_spec(module) is None]
    if missing:
        raise InputError(
            f"{sys.executable} lacks {', '.join(missing)}: apt-get install {' '.join(missing)}, "
            "and start tools/shearbox itself, which takes /usr/bin/python3"
        )


def _interrupt(number: int, _: FrameType | None) -> None:
    raise KeyboardInterrupt(number)


def _how_to_go_on(options: argparse.Namespace) -> str:
    if getattr(options, "command", None) is _run:
        return "stopped; nothing is lost. To go on:\n  " + shlex.join(sys.argv)
    return "stopped"
