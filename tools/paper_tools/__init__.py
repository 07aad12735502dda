# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's study again: campaigns of all its models, its figures, and a test of each of its findings."""
