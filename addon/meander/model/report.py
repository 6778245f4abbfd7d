# SPDX-License-Identifier: GPL-3.0-or-later
"""The machine-readable report of a run: one JSON object, built from the core's figures; no bpy.

Keys are a contract with those who read reports; add to them, never rename them.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from enum import Enum
from pathlib import Path
from typing import Any

from ..core import Gaps
from .empty import empty_of
from .files.whole import whole_file

_SURFACE_KEYS = ("vertices", "faces", "components", "boundary_loops", "area")
_HISTORY_KEYS = ("iteration", "nodes", "length", "mean_step", "energy", "seconds")
# A report names this many gaps at most, the largest; "gap_count" counts them all.
MOST_GAPS = 20
_STAGES = ("total", "medial_axis", "solve", "retract", "reconnect", "crossings", "refine")


def build_report(
    version: str,
    surface: Mapping[str, Any],
    flow: Mapping[str, Any],
    history: Sequence[Mapping[str, Any]],
    gaps: Gaps,
    options: Mapping[str, Any],
) -> dict[str, Any]:
    """The report as a dictionary that JSON can hold.

    version  of the library
    surface  Surface.statistics()
    flow     Flow.statistics()
    history  Flow.history()
    gaps     Flow.gaps(): places that the curve leaves empty, the largest first; a gap's size is its
             radius in units of half the local spacing
    options  every option in effect, by name; echoed under "options"

    Lengths are in the units of the mesh, times in seconds. Numbers that are not finite become
    null, since JSON has none of these.
    """
    report = {
        "version": version,
        "surface": {key: surface[key] for key in (*_SURFACE_KEYS, "turned_faces")},
        "options": dict(options),
        "iterations": flow["iterations"],
        "converged": flow["stop_reason"] == "converged",
        "stop_reason": flow["stop_reason"],
        "nodes": flow["nodes"],
        "strands": flow["strands"],
        "closed_strands": flow["closed_strands"],
        "guides": flow["guides"],
        "empty_components": flow["empty_components"],
        "length": flow["length"],
        "crossings": flow["crossings"],
        "spacing": {
            "target": flow["spacing_target"],
            "median": flow["spacing_median"],
            "p05": flow["spacing_p05"],
            "p95": flow["spacing_p95"],
        },
        "evenness": flow["evenness"],
        "roughness": {
            "mean": flow["roughness"],
            "smoothing": flow["smoothing"],
            "stretch": flow["stretch"],
        },
        "empty": empty_of(gaps).entry(),
        "gap_count": len(gaps),
        "gaps": _largest(gaps),
        "history": [{key: record[key] for key in _HISTORY_KEYS} for record in history],
        "seconds": {stage: flow[f"seconds_{stage}"] for stage in _STAGES},
    }
    return _plain(report)


def _largest(gaps: Gaps) -> list[dict[str, Any]]:
    columns = (gaps.positions, gaps.radii, gaps.sizes)
    rows = zip(*(column[:MOST_GAPS].tolist() for column in columns))
    return [dict(zip(("position", "radius", "size"), row)) for row in rows]


def _plain(value: Any) -> Any:
    """`value` in types that JSON knows."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, Enum):
        return value.name.lower()
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value


def write_report(path: str | Path, report: Mapping[str, Any]) -> None:
    """Writes a report as UTF-8 JSON, atomically.

    Raises FileError when the file cannot be written; it is then as it was.
    """
    text = json.dumps(report, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    with whole_file(Path(path)) as temporary:
        # Names of files may hold bytes that are no letters.
        temporary.write_bytes(text.encode("utf-8", "replace"))
