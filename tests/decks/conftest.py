# SPDX-License-Identifier: GPL-2.0-or-later
"""What the cases are repeated for: both contact laws, and 1, 2 and 4 ranks."""

from typing import Any

import pytest


@pytest.fixture(params=["direct", "incremental"])
def law(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture(params=[1, 2, 4], ids="{}-ranks".format)
def ranks(request: pytest.FixtureRequest) -> int:
    return request.param


ANYWHERE = [("direct", 1, "verlet"), ("incremental", 2, "verlet/cdem"), ("direct", 4, "verlet/cdem")]


@pytest.fixture(params=ANYWHERE, ids=lambda how: "-".join(map(str, how)))
def anywhere(request: pytest.FixtureRequest) -> dict[str, Any]:
    """Law, ranks and run style, each of them at least once, for cases about none of these."""
    return dict(zip(("law", "ranks", "style"), request.param, strict=True))
