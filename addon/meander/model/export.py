# SPDX-License-Identifier: GPL-3.0-or-later
"""The formats of files for machines, by their suffix, and the options of each; no bpy."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .files.rows import write_pieces
from .files.text import read_plain
from .files.whole import FileError, whole_file
from .options.export import ROWS
from .options.option import Values
from .toolpaths import embroidery, lights, ros, usd
from .toolpaths.drawing import Drawing, drawing_of, frame_of, moved
from .toolpaths.dxf import dxf_pieces
from .toolpaths.gcode import Motion, gcode_pieces, own_line
from .toolpaths.gltf import glb_bytes
from .toolpaths.order import AS_IT_IS, NOTHING_LEFT, Order, backwards, gone_on
from .toolpaths.poses import poses_of
from .toolpaths.svg import svg_pieces
from .toolpaths.toolpath import Strand

_OF_LAYOUT = ("layout_as", "visible_only", "force")
_OF_SIZE = (*_OF_LAYOUT, "unit", "scale", "size", "arc_tolerance")
_OF_MOTION = tuple(field.name for field in fields(Motion))
_OF_SCENE = ("layout_as", "visible_only", "scale", "size", "thickness")
# Of poses of a tool, which tables can have as well.
POSES = ("standoff", "approach")
_OF_LIGHTS = ("layout_as", "visible_only", "scale", "size", "pitch")


@dataclass(frozen=True)
class Format:
    """A format of files.

    name, label, tip   as Blender lists it
    suffixes           the first one is added to names without any
    options            the settings of options.export.ROWS that it takes
    flat               everything in it lies in a plane
    unit               its unit of length, one of drawing.UNITS; empty: it is an option
    """

    name: str
    label: str
    tip: str
    suffixes: tuple[str, ...]
    options: tuple[str, ...]
    flat: bool
    unit: str = ""


FORMATS: tuple[Format, ...] = (
    Format(
        "SVG",
        "SVG",
        "Flat drawing for plotters, lasers and print",
        (".svg",),
        (*_OF_SIZE, "line_width"),
        True,
    ),
    Format("DXF", "DXF", "Flat or in space, for CAD and lasers", (".dxf",), _OF_SIZE, False),
    Format(
        "GCODE",
        "G-code",
        "Moves of a plotter, mill or printer",
        (".gcode", ".nc", ".ngc"),
        (*_OF_SIZE, *_OF_MOTION),
        False,
    ),
    Format(
        "DST",
        "Embroidery DST",
        "Stitches, for most machines",
        (".dst",),
        (*_OF_LAYOUT, "scale", "size", "stitch_length", "stitch_tolerance", "stitch_least"),
        True,
        "mm",
    ),
    Format(
        "PES",
        "Embroidery PES",
        "Stitches, for machines of Brother",
        (".pes",),
        (*_OF_LAYOUT, "scale", "size", "stitch_length", "stitch_tolerance", "stitch_least"),
        True,
        "mm",
    ),
    Format(
        "USD",
        "USD",
        "Curves with all that is known of their points, for Houdini, Unreal, Maya",
        usd.SUFFIXES,
        _OF_SCENE,
        False,
        "m",
    ),
    Format("GLB", "glTF", "A tube, or lines, for the web and game engines", (".glb",), _OF_SCENE,
           False, "m"),
    Format(
        "XLIGHTS",
        "xLights Model",
        "Where the LEDs of a strip lie, for xLights",
        (".xmodel",),
        _OF_LIGHTS,
        False,
        "mm",
    ),
    Format(
        "WLED",
        "WLED Map",
        "Where the LEDs of a strip lie in a plane, for WLED",
        (".wled.json",),
        _OF_LIGHTS,
        True,
        "mm",
    ),
    Format(
        "PIXELBLAZE",
        "Pixelblaze Map",
        "Where the LEDs of a strip lie, for Pixelblaze",
        (".pixelblaze.json",),
        _OF_LIGHTS,
        False,
        "mm",
    ),
    Format(
        "ROS",
        "ROS Poses",
        "Poses of a robot's tool, as messages of ROS",
        (".yaml",),
        ("ros_message", *POSES),
        False,
        "m",
    ),
)
SUFFIXES = tuple(suffix for kind in FORMATS for suffix in kind.suffixes)
DEFAULTS: Values = {row.setting: row.default for row in ROWS}


def format_of(path: Path) -> Format | None:
    """The format of a file by its name; None: it is none of these."""
    suffix = suffix_of(path)
    return next((kind for kind in FORMATS if suffix in kind.suffixes), None)


def suffix_of(path: Path) -> str:
    """The end of a file's name that says its format, in small letters, such as ".wled.json"."""
    name = path.name.lower()
    longest = max((s for s in SUFFIXES if name.endswith(s) and name != s), key=len, default="")
    return longest or path.suffix.lower()


def is_flat(kind: Format, values: Values) -> bool:
    """Whether a drawing lies in a plane."""
    return kind.flat or "layout_as" in kind.options and values["layout_as"] != "space"


def is_seen(kind: Format, layout: str) -> bool:
    """Whether a layout shows the curve as an eye sees it, so that the surface can hide it."""
    return layout != "uv" and is_flat(kind, {"layout_as": layout})


def prepared(
    strands: Sequence[Strand],
    kind: Format,
    values: Values,
    metres: float,
    spacing: float = 0.0,
    order: Order = AS_IT_IS,
    frames: Sequence[tuple[float, Sequence[Strand]]] = (),
    rate: float = 24.0,
) -> Drawing:
    """The drawing that a file of a format holds.

    strands   as they are laid: in scene units, at z = 0 where the layout is flat
    values    of options.export.ROWS, by setting; not those of which lacks_plane() is true
    metres    the length of a scene unit
    spacing   the least spacing of neighbouring strands, in scene units; 0: it is not known
    order     from where the drawing goes on and which way, but not where it begins: see
              in_scene_units(). What is left of it lies where it lay in the whole
    frames    times and strands, laid likewise, of a curve that moves, for takes_frames()
    rate      how many of these times are a second

    Of an embroidery it is the thread, stitch by stitch. Raises FileError with one sentence for what
    is no drawing.
    """
    drawing = sized(strands, kind, values, metres, spacing)
    if order.go_on is not None:
        drawing = replace(drawing, strands=gone_on(drawing.strands, order.go_on))
    if order.backwards:
        drawing = replace(drawing, strands=backwards(drawing.strands))
    if not drawing.strands:
        raise FileError(NOTHING_LEFT)
    if frames:
        origin, factor = frame_of(strands, *_frame(kind, values, metres))
        turned = [(time, [moved(each, origin, factor) for each in laid]) for time, laid in frames]
        drawing = replace(drawing, frames=turned, rate=rate)
    if kind.name in ("DST", "PES"):
        return embroidery.stitched(
            drawing, *(values[f"stitch_{name}"] for name in ("length", "tolerance", "least"))
        )
    if "pitch" in kind.options:
        return lights.placed(drawing, values["pitch"])
    if "arc_tolerance" in kind.options and values["arc_tolerance"] > 0.0:
        return drawing.with_arcs(values["arc_tolerance"])
    return drawing


def sized(
    strands: Sequence[Strand], kind: Format, values: Values, metres: float, spacing: float = 0.0
) -> Drawing:
    """Strands in the unit and the size of a format, with the points that they have. See prepared().
    """
    return drawing_of(strands, *_frame(kind, values, metres), spacing=spacing)


def has_own_points(kind: Format) -> bool:
    """Whether a format has points of the curve, which may be chosen, and not stitches or lights."""
    return kind.name not in ("DST", "PES") and "pitch" not in kind.options


def _frame(kind: Format, values: Values, metres: float) -> tuple[str, float, float, float, bool]:
    scale, size = (
        (values["scale"], values["size"]) if "scale" in kind.options else (1.0, 0.0)
    )
    return kind.unit or values["unit"], metres, scale, size, is_flat(kind, values)


def in_scene_units(
    place: ArrayLike, strands: Sequence[Strand], kind: Format, values: Values, metres: float
) -> NDArray[np.float64]:
    """A place of the drawing that prepared() makes of strands, as a place among them."""
    origin, factor = frame_of(strands, *_frame(kind, values, metres))
    wanted = np.asarray(place, dtype=np.float64)
    return wanted / factor + origin[: len(wanted)]


def takes_frames(kind: Format | None) -> bool:
    """Whether a format holds a curve that moves."""
    return kind is not None and kind.name == "USD"


def takes_sheets(kind: Format | None, values: Values) -> bool:
    """Whether a drawing can be parted into sheets of paper."""
    return kind is not None and "arc_tolerance" in kind.options and is_flat(kind, values)


def lacks_plane(kind: Format, values: Values) -> bool:
    """Whether arcs are asked for, which lie in a plane, of a drawing that does not."""
    asked = "arc_tolerance" in kind.options and values["arc_tolerance"] > 0.0
    return asked and not is_flat(kind, values)


def lines_of(path: Path) -> list[str]:
    """The lines of a file of G-code, with comments as any machine takes them; none of an empty one.

    Raises FileError for what is a command to a machine wherever it stands.
    """
    text = read_plain(path, may_be_empty=True).decode("utf-8-sig", "replace")
    return [own_line(line, f"{path}, line {n}") for n, line in enumerate(text.splitlines(), 1)]


def write(
    path: Path,
    kind: Format,
    drawing: Drawing,
    values: Values,
    title: str,
    version: str,
    head: Sequence[str] | None = None,
    foot: Sequence[str] | None = None,
    frame_id: str = ros.FRAME,
) -> None:
    """Writes a drawing, whole or not at all. Raises FileError.

    head, foot   lines of G-code in place of those of the machine
    frame_id     the frame of reference of messages of ROS
    """
    pieces = pieces_of(kind, drawing, values, title, version, path.suffix, head, foot, frame_id)
    with whole_file(path) as temporary:
        write_pieces(temporary, pieces)


def pieces_of(
    kind: Format,
    drawing: Drawing,
    values: Values,
    title: str,
    version: str,
    suffix: str,
    head: Sequence[str] | None = None,
    foot: Sequence[str] | None = None,
    frame_id: str = ros.FRAME,
) -> Iterable[str | bytes]:
    """What a file of a drawing holds, a block after the other; see write()."""
    if kind.name == "SVG":
        return svg_pieces(drawing, values["line_width"], title, version)
    if kind.name == "DXF":
        return dxf_pieces(drawing)
    if kind.name == "GCODE":
        motion = Motion(**{name: values[name] for name in _OF_MOTION})
        return gcode_pieces(drawing, motion, title, version, head, foot)
    if kind.name in ("DST", "PES"):
        return [embroidery.embroidery_bytes(drawing, title, kind.suffixes[0])]
    if kind.name == "XLIGHTS":
        return [lights.xlights_text(drawing, values["pitch"], title)]
    if kind.name == "WLED":
        return [lights.wled_text(drawing, values["pitch"], title)]
    if kind.name == "PIXELBLAZE":
        return [lights.pixelblaze_text(drawing)]
    width = values["thickness"] * drawing.spacing
    if kind.name == "USD":
        return [usd.usd_bytes(drawing, width, title, version, suffix.lower())]
    if kind.name == "GLB":
        return [glb_bytes(drawing, width, title, version)]
    away, farther = (values[name] * drawing.of_scene_unit for name in POSES)
    poses = [poses_of(strand, away, farther) for strand in drawing.strands]
    return [ros.ros_text(poses, values["ros_message"], frame_id, version)]
