# SPDX-License-Identifier: GPL-2.0-or-later
"""The folders of the source, each of which knows itself and those before it."""

ROOMS = ["core", "host", "grains", "contacts", "motion", "output", "entry"]
TOOLS_ROOMS = ["base", "reading", "asking", "running", "analysis", "drawing", "reports", "frames", "jobs", "commands"]
