# SPDX-License-Identifier: GPL-2.0-or-later
"""The phases of runs, and how they are worked through, stopped and taken up."""
