# SPDX-License-Identifier: GPL-2.0-or-later
"""What the cases are repeated for: both contact laws, and 1, 2 and 4 ranks."""

import pytest


@pytest.fixture(params=["direct", "incremental"])
def law(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture(params=[1, 2, 4], ids="{}-ranks".format)
def ranks(request: pytest.FixtureRequest) -> int:
    return request.param
