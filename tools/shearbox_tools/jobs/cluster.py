# SPDX-License-Identifier: GPL-2.0-or-later
"""The file that says what jobs on a cluster need: examples/cluster/cluster.toml, which explains it, is one."""

import tomllib
from dataclasses import dataclass, fields
from pathlib import Path

from ..base.errors import InputError

OF_THE_USER = Path("~/.config/shearbox/cluster.toml")
MOST = 1_000_000  # cores, hours


@dataclass(frozen=True)
class Cluster:
    """Batch system, limits of its jobs, and what its scripts have in addition."""

    scheduler: str = "slurm"
    partition: str = ""  # empty: that of the batch system
    account: str = ""
    cores: int = 0  # of a node; 0: not known, a job takes one for each test of a specimen
    hours: float = 0.0  # that a job may last; 0: as long as it needs
    options: tuple[str, ...] = ()  # of the batch system, a line each
    commands: tuple[str, ...] = ()  # of the shell, before the job's own
    file: Path = OF_THE_USER  # where all this stands, for messages


def read_cluster(path: Path | None) -> Cluster:
    """The file that is named, or the user's; if that is not there, what a cluster without limits needs."""
    if path is None:
        path = OF_THE_USER.expanduser()
        if not path.exists():
            return Cluster()
    try:
        with path.open("rb") as stream:
            given = tomllib.load(stream)
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: {error}") from error
    defaults = {field.name: field.default for field in fields(Cluster) if field.name != "file"}
    for name, value in given.items():
        if name not in defaults:
            raise InputError(f"{path}: {name}: {', '.join(defaults)} are expected")
        if problem := _problem(value, defaults[name]):
            raise InputError(f"{path}: {name} = {value!r}: {problem} is expected")
    return Cluster(**{n: tuple(v) if isinstance(v, list) else v for n, v in given.items()}, file=path)


def _problem(value: object, default: object) -> str | None:
    """What a value should be; None if it is."""
    if isinstance(default, tuple):
        right = isinstance(value, list) and all(isinstance(line, str) and line.isprintable() for line in value)
        return None if right else "a list of lines"
    if isinstance(default, str):
        right = isinstance(value, str) and value.isprintable() and not set(value) & set(" \"'#\\")
        return None if right else "a name without blanks and quotes"
    kinds = (int,) if isinstance(default, int) else (int, float)
    right = type(value) in kinds and isinstance(value, (int, float)) and 0 < value < MOST
    return None if right else "a positive number" + " that is whole" * (kinds == (int,))
