# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages in a browser, and what they tell."""

import html
import json
import os
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

MISSING = [program for program in ("chromium", "pdftotext", "pdfimages") if not shutil.which(program)]
needs_browser = pytest.mark.skipif(
    bool(MISSING), reason=f"no {', '.join(MISSING)}: tools/setup --ci installs chromium and poppler-utils"
)


def chromium(folder: Path, *arguments: str) -> str:
    """What it prints; without a sandbox, as root has to run it, and without a bus that it would wait for."""
    buses = {f"DBUS_{name}_BUS_ADDRESS": "unix:path=/dev/null" for name in ("SESSION", "SYSTEM")}
    command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder / 'profile'}"]
    done = subprocess.run(
        [*command, *arguments], env=os.environ | buses, check=True, capture_output=True, text=True, timeout=60
    )
    return done.stdout


def told(folder: Path, page: Path, *arguments: str) -> Any:
    """What a page has put into its body, as JSON."""
    shown = chromium(folder, *arguments, "--dump-dom", page.as_uri())
    body = re.search(r"<body>(.*)</body>", shown, re.DOTALL)
    assert body, shown[:1000]
    return json.loads(html.unescape(body[1]))
