# SPDX-License-Identifier: GPL-3.0-or-later
"""A curve that grows on a surface: what else is asked of it, and what it has become."""

from __future__ import annotations

from ctypes import byref, c_size_t, sizeof
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import (
    FlowStatisticsRecord,
    GapsRecord,
    IterationRecord,
    NodesRecord,
    PointDataRecord,
    PointParts,
    PolylinesRecord,
    Status,
)
from .calls import Found, call, figures_of, prepared, raise_error
from .context import Context, pointer_of
from .curve import Gaps, Nodes, PointData, Polylines, polylines_of
from .errors import MeanderError
from .finding import Asked, Findings, gaps_of, point_data_of, statistics_of
from .flow_options import FlowOptions, options_record
from .handle import address_of, checked_array
from .named import number_of
from .native_library import native
from .runs import FlowRun


class Flow(FlowRun):
    """A curve that grows on a surface. It belongs to one thread at a time, but for `running`.

    surface   stays usable and may be closed; the flow keeps what it needs of it
    options   see `default_options`; read once
    seed      a Seed, or None: one small closed strand per component
    density   (vertex count of the surface,) float64, each > 0, or None for 1 everywhere: the
              local spacing is the spacing divided by sqrt(density)
    context   where it is cancelled, a MeanderError of the status CANCELLED is raised

    Raises MeanderError for options out of range, a density of the wrong length or sign, and a seed
    that is off the surface, crosses or touches itself, or is too short.
    """

    _asked: Asked | None = None  # of a search that has been begun

    def set_vertices(self, vertices: ArrayLike) -> None:
        """Moves the vertices of the flow's surface, and the curve with it; see the C header.

        vertices  (n, 3) float64, as many and in the order as passed to Surface

        The curve rides on its faces and is straightened; the steps that follow make it even again.
        Raises MeanderError, and leaves the flow as it was, for another number of vertices, a
        coordinate that is not finite, a face without area, and a surface that has become too small
        or too large for the spacing.
        """
        array = checked_array("vertices", vertices, np.float64, 3)
        with self._use() as pointer, pointer_of(None) as cancelling:
            call(
                native().meander_flow_set_vertices,
                pointer,
                address_of(array),
                len(array),
                cancelling,
            )

    def set_radius(self, radius: float) -> None:
        """Asks for another radius, half the spacing, from here on; see the C header.

        radius  > 0, in the units of the surface

        The local radii and the other lengths of the options change in proportion. The curve goes on
        from where it is: run or step until it is even again. Raises MeanderError, and leaves the
        flow as it was, for a radius that a new flow would refuse.
        """
        self._alone("meander_flow_set_radius", number_of("radius", radius))

    def set_density(self, density: ArrayLike | None) -> None:
        """Asks for another density from here on, as set_radius does for the radius.

        density  (vertex count of the surface,) float64, each > 0, or None for 1 everywhere

        Raises MeanderError, and leaves the flow as it was, for one that a new flow would refuse.
        """
        array = None
        if density is not None:
            array = checked_array("density", density, np.float64, None)
        self._alone("meander_flow_set_density", array, 0 if array is None else len(array))

    def set_options(self, options: FlowOptions) -> None:
        """Asks for other options from here on, the radius among them, as set_radius does.

        options  all of them: what is not to change must be as it was. Those that only a beginning
                 needs (widen_loops, start_spacing_factor) and threads have no effect

        Other weights of growth make the curve grow again, from where it is. Raises MeanderError,
        and leaves the flow as it was, for options that a new flow would refuse.
        """
        self._alone("meander_flow_set_options", byref(options_record(options)))

    def statistics(self) -> dict[str, Any]:
        """Figures of the present state, named as in meander_flow_statistics.

        stop_reason is one of STOP_REASONS, polishing a bool, counts are int; lengths are in the
        surface's units, times in seconds. Costs one medial axis and one crossing test.
        """
        record = prepared(FlowStatisticsRecord)
        with self._use() as pointer, pointer_of(None) as cancelling:
            call(native().meander_flow_compute_statistics, pointer, byref(record), cancelling)
        return statistics_of(record)

    def history(self) -> list[dict[str, int | float]]:
        """One record per iteration, oldest first, named as in meander_iteration.

        iteration (from 1) and nodes: int; length, mean_step, energy, seconds: float.
        """
        library = native()
        count = c_size_t()
        with self._use() as pointer:
            size = sizeof(IterationRecord)
            call(library.meander_flow_get_history, pointer, None, size, 0, byref(count))
            records = (IterationRecord * count.value)()
            call(
                library.meander_flow_get_history, pointer, records, size, count.value, byref(count)
            )
        return [figures_of(record) for record in records]

    def polylines(self) -> Polylines:
        """The present curve, nodes and edge crossings; strands come in the order of the seed's."""
        with self._use() as pointer, pointer_of(None) as cancelling:
            found, data = Found(PolylinesRecord), Found(PointDataRecord)
            found.fill(native().meander_flow_get_polylines, pointer)
            points = data.fill(
                native().meander_flow_compute_point_data,
                pointer,
                PointParts.NORMALS,
                context=(cancelling,),
            )
        return polylines_of(found, data.array("normals", points.count, 3))

    def guides(self) -> NDArray[np.bool_]:
        """(s,) bool: which strands are guides, in the order of the polylines."""
        found = Found(PolylinesRecord)
        with self._use() as pointer:
            record = found.fill(native().meander_flow_get_polylines, pointer)
        return found.array("guides", record.strand_count).astype(bool)

    def nodes(self) -> Nodes:
        """The present nodes, strand after strand."""
        found = Found(NodesRecord)
        with self._use() as pointer:
            count = found.fill(native().meander_flow_get_nodes, pointer).count
        return Nodes(
            found.array("faces", count),
            found.array("barycentrics", count, 3),
            found.array("radii", count, 2),
            found.array("fixed", count),
        )

    def point_data(self) -> PointData:
        """What is known of every point of `polylines()`, in their order. Costs a medial axis."""
        found = Found(PointDataRecord)
        with self._use() as pointer, pointer_of(None) as cancelling:
            found.fill(
                native().meander_flow_compute_point_data,
                pointer,
                PointParts.ALL,
                context=(cancelling,),
            )
        return point_data_of(found)

    def rounded(
        self, tolerance: float, context: Context | None = None
    ) -> tuple[Polylines, PointData]:
        """The curve as it is drawn, with round turns, and what is known of its points.

        tolerance   how far any place may be from the curve along the surface, as a share of the
                    local spacing, from 0 to 0.5
        context     where it is cancelled, a MeanderError of the status CANCELLED is raised

        The strands are those of `polylines()`, in their order, with other points. The curve stays
        as it is; see meander_flow_round_curve. Raises MeanderError for a tolerance out of range.
        """
        found, data = Found(PolylinesRecord), Found(PointDataRecord)
        with self._use() as pointer, pointer_of(context) as cancelling:
            try:
                data.fill(
                    native().meander_flow_round_curve,
                    pointer,
                    number_of("tolerance", tolerance),
                    byref(found.record),
                    context=(cancelling,),
                )
            finally:
                found.own()
        of_points = point_data_of(data)
        return polylines_of(found, of_points.normals), of_points

    def gaps(self, least_size: float = 0.0, context: Context | None = None) -> Gaps:
        """The places that the present curve leaves empty; see meander_flow_find_gaps.

        least_size   how far from the curve a place must be to count, in local r, at least 1;
                     0 leaves it to the library, which takes 1.2
        context      where it is cancelled, a MeanderError of the status CANCELLED is raised; its
                     progress goes from 0 to 1, and is afterwards what it was

        Costs one medial axis and a search; the curve stays as it is. Raises MeanderError for a
        size out of range.
        """
        found = Found(GapsRecord)
        with self._use() as pointer, pointer_of(context) as cancelling:
            found.fill(
                native().meander_flow_find_gaps,
                pointer,
                number_of("least size", least_size),
                context=(cancelling,),
            )
        return gaps_of(found)

    def start_finding(
        self, gaps: bool = True, tolerance: float = 0.0, context: Context | None = None
    ) -> None:
        """Begins to find all that is told of the present curve, on a thread of the library's, and
        returns at once; with one medial axis, where the calls for one thing each need one each.

        gaps        whether what it leaves empty is asked for
        tolerance   of `rounded`, which is asked for where this is not 0
        context     shows how far it is, and where it is cancelled, `found` raises

        Until `found`, everything but `running`, `found` and `close` raises MeanderError.
        """
        asked = Asked(gaps, number_of("tolerance", tolerance))
        function = native().meander_flow_start_finding
        self._begin(function, *asked.arguments(), context=context, at_end=asked.own)
        self._asked = asked

    def findings(
        self, gaps: bool = True, tolerance: float = 0.0, context: Context | None = None
    ) -> Findings:
        """What `start_finding` begins, once it is there."""
        self.start_finding(gaps, tolerance, context)
        return self.found()

    def found(self) -> Findings:
        """Waits for what `start_finding` has begun; raises what went wrong in it.

        An interruption from the keyboard cancels it. Raises MeanderError also where nothing has
        been begun.
        """
        with self._use() as pointer:
            asked, self._asked = self._asked, None
            status, error = self._waited(pointer)
        if status != Status.OK:
            raise_error(status, error)
        if asked is None:
            raise MeanderError("the flow has run, and has found nothing; call start_finding first")
        return asked.findings()
