# SPDX-License-Identifier: GPL-3.0-or-later
"""All that is told of a curve at once, which a thread of the library's finds."""

from __future__ import annotations

from ctypes import Structure, byref
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .abi import FlowStatisticsRecord, GapsRecord, PointDataRecord, PolylinesRecord
from .calls import Found, figures_of, prepared
from .choices import STOP_REASONS
from .curve import Gaps, PointData, Polylines, polylines_of


class Findings(NamedTuple):
    """What is told of a curve; the same as by the calls of `Flow` that find one thing each.

    polylines    the curve
    guides       (s,) bool: which of its strands are guides
    point_data   of its points
    statistics   its figures
    gaps         what it leaves empty; None: that was not asked for
    drawn        the curve as it is drawn, and the data of its points; None: that was not asked for
    """

    polylines: Polylines
    guides: NDArray[np.bool_]
    point_data: PointData
    statistics: dict[str, Any]
    gaps: Gaps | None
    drawn: tuple[Polylines, PointData] | None


class Asked:
    """The structs that the library fills meanwhile: to be held until it has ended."""

    def __init__(self, gaps: bool, tolerance: float) -> None:
        self._tolerance = tolerance
        self._lines, self._data = Found(PolylinesRecord), Found(PointDataRecord)
        self._figures = prepared(FlowStatisticsRecord)
        self._gaps = Found(GapsRecord) if gaps else None
        self._drawn = (Found(PolylinesRecord), Found(PointDataRecord)) if tolerance else None

    def arguments(self) -> tuple[Any, ...]:
        """Of meander_flow_start_finding, between the flow and the context."""
        drawn, drawn_data = self._drawn or (None, None)
        return (
            _place(self._lines),
            _place(self._data),
            byref(self._figures),
            _place(self._gaps),
            0.0,
            _place(drawn),
            _place(drawn_data),
            self._tolerance,
        )

    def own(self) -> None:
        """Once the search has ended, however: its memory goes with the last of its arrays."""
        for found in (self._lines, self._data, self._gaps, *(self._drawn or ())):
            if found is not None:
                found.own()

    def findings(self) -> Findings:
        """Once it has ended well."""
        lines, data, drawn = self._lines, point_data_of(self._data), None
        if self._drawn is not None:
            drawn_data = point_data_of(self._drawn[1])
            drawn = polylines_of(self._drawn[0], drawn_data.normals), drawn_data
        return Findings(
            polylines_of(lines, data.normals),
            lines.array("guides", lines.record.strand_count).astype(bool),
            data,
            statistics_of(self._figures),
            None if self._gaps is None else gaps_of(self._gaps),
            drawn,
        )


def _place(found: Found | None) -> Any:
    return None if found is None else byref(found.record)


def statistics_of(record: Structure) -> dict[str, Any]:
    """Figures by their names, as the library has handed them out."""
    values = figures_of(record)
    values["stop_reason"] = STOP_REASONS[record.stop_reason]
    values["polishing"] = bool(record.polishing)
    return values


def point_data_of(found: Found) -> PointData:
    """Data of all parts as the library has handed them out."""
    count = found.record.count
    return PointData(
        found.array("arc_lengths", count),
        found.array("normals", count, 3),
        found.array("tangents", count, 3),
        found.array("radii", count, 2),
        found.array("faces", count),
        found.array("barycentrics", count, 3),
    )


def gaps_of(found: Found) -> Gaps:
    """Gaps as the library has handed them out."""
    count = found.record.count
    return Gaps(
        found.array("positions", count, 3),
        found.array("radii", count),
        found.array("sizes", count),
        found.array("faces", count),
        found.array("narrow", count).astype(bool),
        found.record.empty_share,
        found.record.narrow_share,
    )
