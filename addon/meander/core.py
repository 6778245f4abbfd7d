# SPDX-License-Identifier: GPL-3.0-or-later
"""The bridge to the native library: numpy in, numpy out, no bpy.

This is the door. Behind it is the room `binding`, and nothing else knows ctypes.

    surface = Surface(vertices, faces)           checked and copied by the library
    options = default_options("even")            defaults live in the library only
    options.radius = spacing / 2
    flow = Flow(surface, options, seed, density)
    flow.run(context)                            context.cancel() from any thread
    curve = flow.polylines()

    flow.start(context)                          the same run on a thread of the library's
    while flow.running:
        preview = flow.preview()                 the curve as it grows; None: nothing new
    reason = flow.wait()

    begun = Surface.work(vertices, faces).begin(context)    likewise what lasts before a run
    while begun.running:
        ...
    surface = begun.result()

Lengths are in the units of the vertices; indices are zero-based. Everything that goes wrong is a
`MeanderError` whose text is one sentence for people. Calls into the library release the GIL. What
lasts in the main thread is cancelled by an interruption from the keyboard (`binding/interruption`).

Threads: a surface may be shared, a flow belongs to one thread at a time (a second thread gets a
`MeanderError`), a context may be touched from any thread at any time. A host that must not have a
Python thread of its own starts the flow, and the library runs it on one that knows no Python.
"""

from __future__ import annotations

from .binding.abi import (
    ABI_VERSION,
    VERSION,
    BoundaryRule,
    MedialAxis,
    Start,
    Status,
    StopRule,
    Text,
)
from .binding.choices import (
    ALIGNMENTS,
    CURVATURES,
    DIRECTIONS,
    ELEMENT_KINDS,
    FAULTS,
    PHASES,
    PRESETS,
    STOP_REASONS,
)
from .binding.context import Context
from .binding.cost import Cost, Extent, estimate_cost
from .binding.curve import Gaps, Nodes, PointData, Polylines, Preview
from .binding.cut import NO_STRAND, CutSurface, cut_surface
from .binding.errors import STATUS_NO_LIBRARY, MeanderError
from .binding.files import (
    TextPolygons,
    read_numbers,
    read_polygons,
    text_rows,
    triangulated,
)
from .binding.finding import Findings
from .binding.flow import Flow
from .binding.flow_options import FlowOptions, default_options, option_warnings
from .binding.maps import CutPlaces, MapPixels, cut_places, map_pixels
from .binding.mesh_search import Closest, Faults, find_closest, find_faults
from .binding.named import unknown_name
from .binding.native_library import (
    LIBRARY_VARIABLE,
    library_notice,
    library_path,
    library_version,
    struct_layouts,
)
from .binding.seed import Seed
from .binding.spacing import area_of, automatic_spacing, spacing_for
from .binding.surface import Surface
from .binding.surface_options import SurfaceOptions
from .binding.work import Begun, Work

# What hosts use; they import nothing else of these modules.
__all__ = [
    "ABI_VERSION",
    "ALIGNMENTS",
    "CURVATURES",
    "DIRECTIONS",
    "ELEMENT_KINDS",
    "FAULTS",
    "LIBRARY_VARIABLE",
    "NO_STRAND",
    "PHASES",
    "PRESETS",
    "STATUS_NO_LIBRARY",
    "STOP_REASONS",
    "VERSION",
    "Begun",
    "BoundaryRule",
    "Closest",
    "Context",
    "Cost",
    "CutPlaces",
    "CutSurface",
    "Extent",
    "Faults",
    "Findings",
    "Flow",
    "FlowOptions",
    "Gaps",
    "MapPixels",
    "MeanderError",
    "MedialAxis",
    "Nodes",
    "PointData",
    "Polylines",
    "Preview",
    "Seed",
    "Status",
    "Start",
    "StopRule",
    "Surface",
    "SurfaceOptions",
    "Text",
    "TextPolygons",
    "Work",
    "area_of",
    "automatic_spacing",
    "cut_places",
    "cut_surface",
    "default_options",
    "estimate_cost",
    "find_closest",
    "find_faults",
    "library_notice",
    "library_path",
    "library_version",
    "map_pixels",
    "option_warnings",
    "read_numbers",
    "read_polygons",
    "spacing_for",
    "struct_layouts",
    "text_rows",
    "triangulated",
    "unknown_name",
]
