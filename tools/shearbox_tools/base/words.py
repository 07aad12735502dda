# SPDX-License-Identifier: GPL-2.0-or-later
"""Times and amounts of memory as people say them."""

LEAST_SECONDS = 0.5  # that are told


def about(seconds: float) -> str:
    """An estimate of a time."""
    return duration(seconds) if seconds < LEAST_SECONDS else f"about {duration(seconds)}"


def duration(seconds: float) -> str:
    """Seconds as people say them: 48 s, 12 min, 3 h 20 min."""
    if seconds < LEAST_SECONDS:
        return "under 1 s"
    if seconds < 100:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 100 else f"{minutes // 60} h {minutes % 60} min"


def amount(size: float) -> str:
    """Bytes as people say them: 46 MB, 4.8 GB."""
    return f"{size / 1e6:.0f} MB" if size < 999.5e6 else f"{size / 1e9:.1f} GB"
