# SPDX-License-Identifier: GPL-2.0-or-later
"""Run the direct shear test of sand with lmp_cdem and report on it."""

# The one place of the version: CMakeLists.txt reads it from here, and a test compares CITATION.cff.
__version__ = "0.1.0"
