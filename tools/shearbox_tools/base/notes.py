# SPDX-License-Identifier: GPL-2.0-or-later
"""What a reader of the results must know, said once for all the stresses that it is true of."""

Remark = tuple[float, str]  # normal stress (kPa), and what is true of it


def said_once(remarks: list[Remark]) -> list[str]:
    """A note for each different text, which begins with its stresses."""
    stresses: dict[str, list[str]] = {}
    for sigma, text in remarks:
        stresses.setdefault(text, []).append(f"{sigma:g}")
    return [f"{', '.join(found)} kPa: {text}" for text, found in stresses.items()]
