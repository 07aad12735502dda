# SPDX-License-Identifier: GPL-2.0-or-later
"""The one exception whose message is meant for the user as it stands."""


class ShearboxError(Exception):
    """Something the user can act on; `code` is the exit status of the program."""

    def __init__(self, message: str, code: int = 1) -> None:
        super().__init__(message)
        self.code = code


class InputError(ShearboxError):
    """A request that cannot be carried out as it was given; nothing has been started."""

    def __init__(self, message: str) -> None:
        super().__init__(message, code=2)
