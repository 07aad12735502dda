# SPDX-License-Identifier: GPL-2.0-or-later
"""What needs nothing of the other rooms: errors, numbers as text, files and their seals, locks, logs, words."""
