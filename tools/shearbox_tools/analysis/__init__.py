# SPDX-License-Identifier: GPL-2.0-or-later
"""What tests tell: a stress, a run, an ensemble, and how ensembles differ."""
