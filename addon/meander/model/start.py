# SPDX-License-Identifier: GPL-3.0-or-later
"""How a run began: what was asked, what began full, and what has grown and why; no bpy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

# Figures of Flow.statistics(), and why so many parts have grown that were to begin full.
_WHY = {
    "start_no_room_parts": "no line has room, as where the surface is narrower than two spacings",
    "start_crossing_parts": "nothing could be laid without a crossing",
}


def entry(figures: Mapping[str, Any], asked_full: bool) -> dict[str, Any]:
    """The report's "start"."""
    return {
        "asked": "full" if asked_full else "grow",
        "full_parts": int(figures.get("start_full_parts", 0)),
        "grown_parts": int(figures.get("start_grown_parts", 0)),
        "completed_parts": int(figures.get("completed_parts", 0)),
        "why": _reasons(figures),
    }


def _reasons(figures: Mapping[str, Any]) -> list[str]:
    counts = ((int(figures.get(name, 0)), why) for name, why in _WHY.items())
    return [f"{_parts(count)}: {why}" for count, why in counts if count]


def remark(figures: Mapping[str, Any]) -> str:
    """What to say of parts that began otherwise than asked; else nothing."""
    grown = int(figures.get("start_grown_parts", 0))
    if not grown:
        return ""
    full = int(figures.get("start_full_parts", 0))
    have = "has" if grown == 1 else "have"
    return (
        f"{grown:,} of {_parts(grown + full)} {have} grown instead of beginning full "
        f"({'; '.join(_reasons(figures))})"
    )


def notice(figures: Mapping[str, Any]) -> str:
    """The same, as short as a panel is wide."""
    grown = int(figures.get("start_grown_parts", 0))
    if not grown:
        return ""
    why = "no room" if int(figures.get("start_no_room_parts", 0)) == grown else "see the report"
    return f"{_parts(grown)} grew, not full: {why}"


def _parts(count: int) -> str:
    return "1 part" if count == 1 else f"{count:,} parts"
