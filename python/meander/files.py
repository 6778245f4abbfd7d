# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and curves in files, by the file's suffix; every file is written whole or not at all."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .core import CutSurface, Flow, Seed, library_version, unknown_name
from .model import before_writing, export, sheets
from .model import cut as cut_files
from .model.files import meshes
from .model.files.obj import read_obj_curve, write_obj_curve
from .model.files.whole import FileError, path_of, whole_file
from .model.options.export import ROWS
from .model.options.machines import without_effect
from .model.options.option import Option
from .model.toolpaths import ros, toolpath
from .model.toolpaths.drawing import VIEWS, Drawing, axes_of, seen_along
from .model.toolpaths.sheets import MARGIN, Paper

# What write_curve takes, by its suffix.
_CURVES = (".obj", *toolpath.SUFFIXES, *export.SUFFIXES)
# The options of drawings, by the names of their flags.
_DRAWING = {row.flag.destination: row for row in ROWS if row.flag is not None}
# What only Blender knows: what is hidden, a UV map, the view in a window.
_LAYOUTS = ("space", *VIEWS)
_IN_BLENDER = ("visible_only",)
# What the command does to the line before it is drawn.
_OF_THE_COMMAND = (
    *("header", "footer", "part_length", "part_overlap", "begin_at", "go_on_from", "backwards"),
    *("poses", "outward", "light", "point_limit", "round", "lines"),
)


def read_mesh(path: str | Path) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Reads the mesh in an OBJ, PLY or STL file, in the file's own coordinates.

    Returns vertices (n, 3) and triangles (m, 3), zero-based; polygons become the triangles that
    Blender makes of them, and corners of an STL file at the same place are one vertex.

    Raises FileError: the file cannot be read, is of another kind or malformed, has no faces.
    """
    return meshes.read_mesh(path_of(path))


def read_curve(path: str | Path) -> Seed:
    """Reads the `v` and `l` lines of an OBJ file as strands for a seed or guides.

    Raises FileError: the file cannot be read, is malformed, has no lines, or a strand branches.
    """
    return read_obj_curve(path_of(path))


def write_curve(
    path: str | Path,
    flow: Flow,
    *,
    step: float | None = None,
    tolerance: float | None = None,
    frame_id: str = ros.FRAME,
    sheet: tuple[float, float] | None = None,
    sheet_margin: float = MARGIN,
    **drawing: Any,
) -> None:
    """Writes the curve of a flow in the format of the file's suffix.

    path        .obj: v and l lines, with all digits; .csv, .json and .npz: every point with
                normal, tangent, arc length, medial radii, and the triangle that holds it; .svg,
                .dxf, .gcode, .nc, .ngc, .dst and .pes: drawings; .usda, .usdc, .usd and .glb:
                curves of a scene; .xmodel, .wled.json and .pixelblaze.json: where LEDs lie; .yaml:
                poses
    step        points at equal arc lengths along each strand, at most this far apart; their
                triangles are not known
    tolerance   as few points as keep the chords between them this near the curve
    frame_id    the frame of reference that a .yaml of ROS names
    sheet, sheet_margin   width and height, and the white on all sides, in millimetres: a flat .svg,
                .dxf or G-code is also written in sheets of paper, NAME_r1c1 and so on
    drawing     of all but .obj, .csv, .json and .npz, named as the flags of the command are: layout
                ("space", "top", "front", "side"), unit ("mm", "cm", "in"), scale, size, line_width,
                feed, travel_feed, lift, layer_offset, layers, layer_height, extrusion, tool,
                machine, power, servo_down, servo_up, relative, arcs, stitch_length,
                stitch_tolerance, least_stitch, force, thickness, pitch, ros_message, standoff,
                approach.
                A unit of the mesh is a metre

    Raises FileError: the file cannot be written, or an option means nothing for its format.
    """
    path = path_of(path)
    step, tolerance = _checked_lengths(path, flow, step, tolerance, frame_id)
    suffix, kind = export.suffix_of(path), export.format_of(path)
    values = drawing_values(suffix, kind, drawing)
    paper = _paper(sheet, sheet_margin)
    if paper is not None and not export.takes_sheets(kind, values):
        raise FileError("sheet is for a flat .svg, .dxf or G-code; choose such a file and layout")
    if kind is not None and export.lacks_plane(kind, values):
        raise FileError('arcs lie in a plane; choose a layout that is flat, such as "top"')
    if suffix == ".obj":
        write_obj_curve(path, flow.polylines())
        return
    strands = toolpath.strands_of(flow.polylines(), flow.point_data())
    if kind is not None and export.is_seen(kind, values["layout_as"]):
        strands = seen_along(strands, *axes_of(values["layout_as"]))
    strands = toolpath.resampled(strands, step, tolerance)
    if kind is None:
        toolpath.write(path, strands, library_version())
        return
    spacing = float(flow.statistics()["spacing_target"])
    drawn = export.prepared(strands, kind, values, metres=1.0, spacing=spacing)
    _refuse_unusable(drawn, kind, values)
    if paper is not None:
        sheets.write(path, kind, drawn, values, paper, library_version())
    title = path.name[: -len(suffix)]
    export.write(path, kind, drawn, values, title, library_version(), frame_id=frame_id)


def _refuse_unusable(drawn: Drawing, kind: export.Format, values: dict[str, Any]) -> None:
    problem = before_writing.unusable(drawn, kind, values)
    if problem is not None:
        way = "choose another layout" if problem.edge else "choose a size or scale"
        raise FileError(f"the drawing {problem.what}; {way}, or force=True")


def _paper(sides: Any, margin: Any) -> Paper | None:
    """The sheets that are asked for; None: none are."""
    if sides is None:
        return None
    try:
        width, height = (float(side) for side in sides)
        found = Paper(width, height, float(margin))
    except (TypeError, ValueError):
        raise FileError(
            f"sheet {sides!r} with a sheet_margin of {margin!r} is no paper; give width and "
            "height, and the margin, in millimetres"
        ) from None
    if not (np.isfinite([width, height]).all() and found.margin >= 0.0 and found.has_room):
        raise FileError(
            f"a sheet_margin of {margin!r} leaves nothing of a sheet of {sides!r}; choose others"
        )
    return found


def _checked_lengths(
    path: Path, flow: Any, step: float | None, tolerance: float | None, frame_id: Any
) -> list[float | None]:
    """Step and tolerance as numbers. Raises FileError for what cannot be written so."""
    if not isinstance(flow, Flow):
        raise FileError(f"flow must be a Flow, not a {type(flow).__name__}; write that of one")
    if export.suffix_of(path) not in _CURVES:
        raise FileError(
            f"{path} is no {', '.join(_CURVES[:-1])} or {_CURVES[-1]} file; choose another suffix"
        )
    if not isinstance(frame_id, str):
        raise FileError(f"frame_id {frame_id!r} is no name; give a str")
    if step is not None and tolerance is not None:
        raise FileError("step and tolerance are both given; choose one")
    if export.suffix_of(path) == ".obj" and not (step is None and tolerance is None):
        raise FileError("an .obj file has the whole curve; leave out step and tolerance")
    for name, length in (("step", step), ("tolerance", tolerance)):
        if length is not None and not _is_positive(length):
            raise FileError(f"{name} {length!r} is not a finite number greater than 0")
    return [None if length is None else float(length) for length in (step, tolerance)]


def _is_positive(length: Any) -> bool:
    try:
        return 0.0 < float(length) < np.inf
    except (TypeError, ValueError, OverflowError):
        return False


def write_cut(path: str | Path, cut: CutSurface, spacing: float) -> None:
    """Writes a surface cut along its curve, from cut_surface(), as .obj or .ply.

    path      .obj has the two sides as materials and the curve as l lines; .ply has the distance
              at each vertex, side, strand and region of each face, and the curve as edges
    spacing   what a unit of the UV map along the curve is long

    Raises FileError: the file cannot be written, or is of another kind.
    """
    path = path_of(path)
    if not isinstance(cut, CutSurface):
        raise FileError(f"cut must be a CutSurface, not a {type(cut).__name__}; cut a surface")
    if not _is_positive(spacing):
        raise FileError(f"spacing {spacing!r} is not a finite number greater than 0")
    if path.suffix.lower() not in cut_files.SUFFIXES:
        raise FileError(f"{path} is no .obj or .ply file; choose another suffix")
    with whole_file(path) as temporary:
        cut_files.write(temporary, cut, float(spacing))


def drawing_values(
    suffix: str, kind: export.Format | None, drawing: dict[str, Any]
) -> dict[str, Any]:
    """The options of a drawing by setting, with the defaults of those that are not given."""
    values = dict(export.DEFAULTS)
    for name, value in drawing.items():
        row = _DRAWING.get(name)
        if row is None and name in _OF_THE_COMMAND:
            raise FileError(f"{name} is an option of the command meander only; leave it out")
        if row is None:
            known = [option for option in _DRAWING if option not in _IN_BLENDER]
            raise FileError(unknown_name("option", name, known))
        if name in _IN_BLENDER:
            raise FileError(f"{name} needs Blender; leave it out")
        if kind is None or row.setting not in kind.options:
            raise FileError(f"{name} does nothing for a {suffix} file; leave it out")
        values[row.setting] = _checked(name, value, row)
    given = {_DRAWING[name].setting for name in drawing}
    idle = without_effect(given, values)
    if idle is not None:
        setting, other, choices = idle
        names = {row.setting: name for name, row in _DRAWING.items()}
        raise FileError(
            f"{names[setting]} is for {' '.join([names[other], choices]).strip()}; give both or "
            "none"
        )
    return values


def _checked(name: str, value: Any, row: Option) -> Any:
    """A value within the limits of its option."""
    if row.kind is str:
        choices = [choice for choice, _label, _tip in row.choices]
        if name == "layout":
            choices = [choice for choice in choices if choice in _LAYOUTS]
        if value not in choices:
            raise FileError(f"{name} {value!r} is not known; choose from {', '.join(choices)}")
        return value
    try:
        number = row.kind(value)
    except (TypeError, ValueError, OverflowError):
        raise FileError(f"{name} {value!r} is not a number") from None
    if row.kind is bool and not isinstance(value, (bool, np.bool_)):
        raise FileError(f"{name} {value!r} is neither True nor False")
    if row.kind is int and number != value:
        raise FileError(f"{name} {value!r} is not a whole number")
    least = -np.inf if row.least is None else row.least
    greatest = np.inf if row.greatest is None else row.greatest
    if not least <= number <= greatest:
        raise FileError(
            f"{name} {value!r} is out of range; choose from {least:.12g} to {greatest:.12g}"
        )
    return number
