# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables and dumps of the engine."""
