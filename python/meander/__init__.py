# SPDX-License-Identifier: GPL-3.0-or-later
"""Grow a curve on a triangle mesh until it fills the surface at an even spacing.

    import meander

    vertices, faces = meander.read_mesh("spot.obj")         # or arrays: (n, 3) and (m, 3)
    options = meander.default_options("even")
    options.radius = 0.05                                   # half the spacing; 0: automatic
    with meander.Surface(vertices, faces) as surface:
        flow = meander.Flow(surface, options)
    reason = flow.run()                                     # "converged"
    curve = flow.polylines()                                # positions, offsets, closed, ...
    meander.write_curve("spot.svg", flow, layout="top")

Lengths are in the units of the vertices; indices are zero-based. What goes wrong with a mesh or a
wish is a `MeanderError`, with a file a `FileError`: one sentence for people. Calls into the library
release the GIL; a surface may be shared between threads, a flow belongs to one at a time, and a
`Context` may be cancelled from any.

The modules are those of the Blender add-on. What is named here is for you; what is inside of them
changes without notice.
"""

from .core import (
    ABI_VERSION,
    ALIGNMENTS,
    CURVATURES,
    DIRECTIONS,
    ELEMENT_KINDS,
    FAULTS,
    LIBRARY_VARIABLE,
    NO_STRAND,
    PHASES,
    PRESETS,
    STATUS_NO_LIBRARY,
    STOP_REASONS,
    BoundaryRule,
    Closest,
    Context,
    Cost,
    CutSurface,
    Extent,
    Faults,
    Flow,
    FlowOptions,
    Gaps,
    MeanderError,
    MedialAxis,
    Nodes,
    PointData,
    Polylines,
    Preview,
    Seed,
    Status,
    StopRule,
    Surface,
    SurfaceOptions,
    automatic_spacing,
    cut_surface,
    default_options,
    estimate_cost,
    find_closest,
    find_faults,
    library_path,
    library_version,
    option_warnings,
)
from .core import VERSION as __version__
from .files import read_curve, read_mesh, write_curve, write_cut
from .model.files.whole import FileError
from .pictures import Drawing, draw_picture, tone_density

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
    "BoundaryRule",
    "Closest",
    "Context",
    "Cost",
    "CutSurface",
    "Drawing",
    "Extent",
    "Faults",
    "FileError",
    "Flow",
    "FlowOptions",
    "Gaps",
    "MeanderError",
    "MedialAxis",
    "Nodes",
    "PointData",
    "Polylines",
    "Preview",
    "Seed",
    "Status",
    "StopRule",
    "Surface",
    "SurfaceOptions",
    "__version__",
    "automatic_spacing",
    "cut_surface",
    "default_options",
    "draw_picture",
    "estimate_cost",
    "find_closest",
    "find_faults",
    "library_path",
    "library_version",
    "option_warnings",
    "read_curve",
    "read_mesh",
    "tone_density",
    "write_curve",
    "write_cut",
]

# Tracebacks and help() call them by the names that programs import.
for _name in __all__:
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = __name__
del _name
