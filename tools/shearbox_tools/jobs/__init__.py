# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs on a cluster: their layout, record and batch system."""
