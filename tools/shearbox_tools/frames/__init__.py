# SPDX-License-Identifier: GPL-2.0-or-later
"""Frames for other programs, and films."""
