# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages and summaries on a run, on ensembles, on how they differ; the player."""
