# SPDX-License-Identifier: GPL-2.0-or-later
"""Campaign files: TOML that asks for many runs with the options of `shearbox run`.

    [all]                                        # for all of them
    stress = [100, 200, 300, 400]
    seeds = 8

    [runs.fine]                                  # into the folder OUT/fine
    model = "TypeA_10x5_2-4_1-circle_1500"
    set = { phi = 30 }

An option of a run counts before that of [all], one of the command line before both; `set` is put together variable by variable. A
model file, NAME.in, is looked for from the folder of the campaign file.
"""

import argparse
import difflib
import re
import tomllib
from collections.abc import Callable, Collection, Iterable
from pathlib import Path
from typing import Any, NoReturn

from ..base.errors import InputError
from ..jobs.submitted import JOBS

ENDING = ".toml"
_NAME = re.compile(r"[\w.+-]*\w")
_OURS, _ENDINGS = (JOBS, "export", "compare"), (".html", ".json", ".csv")
OF_ALL, RUNS = "all", "runs"

Options = dict[str, Any]


class OptionParser(argparse.ArgumentParser):
    """Complains by InputError, without a usage."""

    def error(self, message: str) -> NoReturn:
        """Instead of leaving the program."""
        raise InputError(message)


def is_campaign(model: str) -> bool:
    """Whether what stands in place of MODEL is a campaign file."""
    return model.endswith(ENDING)


def read_campaign(
    path: Path, names: Collection[str], parse: Callable[[list[str]], Options], given: Options
) -> list[Options]:
    """What each run is asked for, `out` included: `names` are those of the options that a run may have, `parse` reads words of a
    command line, `given` is what the real one says."""
    out = given.get("out")
    if out is None:
        raise InputError(f"{path}: --out is needed")
    of_all, runs = _tables(path)
    only = given.get("only", list(runs))
    if unknown := [name for name in only if name not in runs]:
        raise InputError(f"--only {' '.join(unknown)}: {path} has {', '.join(runs)}")
    asked = []
    for name, table in ((name, table) for name, table in runs.items() if name in only):
        layers = [_parsed(path, where, t, names, parse) for where, t in ((OF_ALL, of_all), (f"{RUNS}.{name}", table))]
        options = _put_together([*layers, {name: value for name, value in given.items() if name != "model"}])
        if "model" not in options:
            raise InputError(f"{path}: [{RUNS}.{name}]: there is no model")
        if options["model"].endswith(".in"):
            options["model"] = str(path.parent / options["model"])
        asked.append(options | {"out": out / name})
    return asked


def _tables(path: Path) -> tuple[Options, dict[str, Options]]:
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: this is no TOML: {error}") from error
    runs = tables.get(RUNS)
    unknown = [name for name in tables if name not in (OF_ALL, RUNS)]
    if unknown or not isinstance(runs, dict) or not runs:
        raise InputError(f"{path}: [{OF_ALL}] and [{RUNS}.NAME] are expected" + "".join(f", not {n}" for n in unknown))
    for name, table in [(OF_ALL, tables.get(OF_ALL, {})), *runs.items()]:
        if not isinstance(table, dict):
            raise InputError(f"{path}: {name} = {table!r}: a table is expected")
        if not _NAME.fullmatch(name):
            raise InputError(f"{path}: [{RUNS}.{name}]: letters, digits, _ . + - are expected")
        if name in _OURS or name.endswith(_ENDINGS):
            raise InputError(
                f"{path}: [{RUNS}.{name}]: files and folders of reports and jobs have such names; take another"
            )
    return tables.get(OF_ALL, {}), runs


def _parsed(
    path: Path, where: str, table: Options, names: Collection[str], parse: Callable[[list[str]], Options]
) -> Options:
    if unknown := [name for name in table if name not in names]:
        close = difflib.get_close_matches(unknown[0], names, 1)
        hint = f"did you mean {close[0]}" if close else f"there are {', '.join(names)}"
        raise InputError(f"{path}: [{where}]: there is no option {unknown[0]} of a run; {hint}")
    words = [str(table["model"])] if "model" in table else ["-"]
    for name, value in table.items():
        if name != "model":
            words += words_of(name, value)
    try:
        options = parse(words)
    except InputError as error:
        raise InputError(f"{path}: [{where}]: {error}") from error
    options |= {name: False for name, value in table.items() if value is False}  # undoes what is true for all
    return options if "model" in table else {name: value for name, value in options.items() if name != "model"}


def words_of(name: str, value: Any) -> list[str]:
    """An option of the command line; true is one without a value, false and None are none. Seeds in a list are seeds, even if it
    is only one, which on the command line would be their number."""
    if value is None:
        return []
    if isinstance(value, bool):
        return [f"--{name}"] * value
    if isinstance(value, dict):
        value = [f"{variable}={amount}" for variable, amount in value.items()]
    several = not isinstance(value, str) and isinstance(value, Iterable)
    if several and name == "seeds":
        value = [f"{seed}-{seed}" if isinstance(seed, int) else seed for seed in value]
    return [f"--{name}", *map(str, value if several else [value])]


def _put_together(layers: list[Options]) -> Options:
    """The later counts before the earlier."""
    options: Options = {}
    for layer in layers:
        ours = {text.partition("=")[0].strip() for text in layer.get("set", [])}
        kept = [text for text in options.get("set", []) if text.partition("=")[0].strip() not in ours]
        options |= layer
        options = {name: value for name, value in options.items() if value is not False}
        if settings := kept + layer.get("set", []):
            options["set"] = settings
    return options
