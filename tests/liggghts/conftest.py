# SPDX-License-Identifier: GPL-2.0-or-later
"""What the cases are repeated for, and the one reason for which they are skipped."""

import pytest
from host import LIBRARY, PROGRAM


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    if PROGRAM is None:
        reason = "liggghts is not installed (Debian: apt-get install liggghts libliggghts-dev)"
    elif not LIBRARY.exists():
        reason = f"{LIBRARY} is not built (Debian: apt-get install libliggghts-dev, then tools/setup)"
    else:
        return
    for item in items:
        if "liggghts" in item.path.parts[-2]:
            item.add_marker(pytest.mark.skip(reason=reason))


@pytest.fixture(params=["direct", "incremental"])
def law(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(params=[1, 2], ids="{}-ranks".format)
def ranks(request: pytest.FixtureRequest) -> int:
    return int(request.param)
