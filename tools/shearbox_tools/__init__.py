# SPDX-License-Identifier: GPL-2.0-or-later
"""Run the direct shear test of sand with lmp_cdem and report on it."""

__version__ = "0.1.0"
