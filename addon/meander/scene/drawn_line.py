# SPDX-License-Identifier: GPL-3.0-or-later
"""The line that is drawn in place of a result's curve: the same with round turns.

The library makes it, within a tolerance that the look of the result has as *Round*. It is a curve
object of its own that no collection holds; the node group of the look takes its splines in place of
those of the result, as long as these are what it was made of. It goes with the last look that names
it.
"""

from __future__ import annotations

import hashlib

import bpy
import numpy as np

from .. import core
from ..model.geometry.blocks import blocks
from .columns import column
from .curve_writer import write_splines
from .look import modifier_of, set_value, shaping_modifiers, value_of
from .profile import set_tilt_and_radius

# Of what Blender keeps in single precision.
_ROUNDING = 1e-6


def tolerance_of(result: bpy.types.Object) -> float:
    """How far the drawn line of a result may be from its curve, in spacings; 0: it is the curve."""
    modifier = modifier_of(result)
    return 0.0 if modifier is None else float(value_of(modifier, "Round") or 0.0)


def is_due(result: bpy.types.Object) -> bool:
    """Whether the look of a result asks for another line than it has; cheap, for panels."""
    figures = result.meander.figures
    if not figures.round_of:  # it has been edited, or no run has left it
        return False
    return abs(tolerance_of(result) - figures.round_told) > _ROUNDING


def draw(
    result: bpy.types.Object,
    line: core.Polylines | None,
    matrix: np.ndarray,
    factors: np.ndarray | None = None,
    guides: np.ndarray | None = None,
) -> None:
    """Gives the look of a result the line that it draws, for what the result's splines are now.

    line     in world units, with normals, as `matrix` is the surface's; None: the curve itself
    factors  radius of every point; None: 1
    guides   which strands of it are not shown; None: all are
    """
    modifier = modifier_of(result)
    if modifier is None:
        return
    figures = result.meander.figures
    own = _positions(result.data)
    figures.round_told, figures.round_of = tolerance_of(result), digest_of_points(own)
    drawn = None
    if line is not None:
        curve = bpy.data.curves.new(f"{result.name} Round", "CURVE")
        curve.twist_mode = result.data.twist_mode
        write_splines(curve, line, matrix)
        set_tilt_and_radius(curve, line, matrix, factors)
        if guides is not None:
            for spline in [s for s, hidden in zip(curve.splines, guides) if hidden]:
                curve.splines.remove(spline)
        drawn = bpy.data.objects.new(curve.name, curve)
    earlier = drawn_of(result)
    set_value(modifier, "Round Line", drawn)
    # An object that is named now, or no more: only the choice of a group says so to Blender.
    group = modifier.node_group
    modifier.node_group = group
    set_value(modifier, "Round Points", 0 if drawn is None else _point_count(result.data))
    set_value(modifier, "Round Length", 0.0 if drawn is None else _length(result.data, own))
    if earlier is not None:
        remove_unused(earlier)
    result.update_tag()


def drawn_of(result: bpy.types.Object) -> bpy.types.Object | None:
    """The object that holds the drawn line of a result; None: it draws its curve."""
    modifier = modifier_of(result)
    return None if modifier is None else value_of(modifier, "Round Line")


def seen_instead(result: bpy.types.Object) -> bpy.types.Object | None:
    """The object whose splines are seen in place of a result's; None: its own are. They are in the
    result's space."""
    drawn, modifier = drawn_of(result), modifier_of(result)
    if drawn is None or shaping_modifiers(result):
        return None
    if not (modifier.show_viewport or modifier.show_render):
        return None
    if value_of(modifier, "Round Points") != _point_count(result.data):
        return None
    return drawn if digest_of_curve(result.data) == result.meander.figures.round_of else None


def remove_unused(thing: bpy.types.Object) -> None:
    """Takes a curve object out of the file, unless something uses it; and its data likewise."""
    if thing.users:
        return
    data = thing.data
    bpy.data.objects.remove(thing)
    if data.users == 0:
        bpy.data.curves.remove(data)


def on_update(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph | None = None) -> None:
    """Draws the curve itself where somebody has changed its points."""
    for update in () if depsgraph is None else depsgraph.updates:
        curve = update.id.original
        if not isinstance(curve, bpy.types.Curve) or not update.is_updated_geometry:
            continue
        for thing in bpy.data.objects:
            if thing.data == curve and thing.library is None and thing.meander.figures.round_of:
                _drop_where_changed(thing)


def _drop_where_changed(thing: bpy.types.Object) -> None:
    modifier = modifier_of(thing)
    if modifier is None or not value_of(modifier, "Round Points"):
        return
    if thing.mode != "EDIT" and digest_of_curve(thing.data) != thing.meander.figures.round_of:
        set_value(modifier, "Round Points", 0)
        thing.meander.figures.round_of = ""


def _positions(curve: bpy.types.Curve) -> list[np.ndarray]:
    return [column(spline.points, "co", 4)[:, :3] for spline in curve.splines]


def _point_count(curve: bpy.types.Curve) -> int:
    return sum(len(spline.points) for spline in curve.splines)


def _length(curve: bpy.types.Curve, positions: list[np.ndarray]) -> float:
    length = 0.0
    for spline, points in zip(curve.splines, positions):
        for begin, end in blocks(len(points) - 1):
            steps = np.diff(points[begin : end + 1], axis=0)
            length += float(np.linalg.norm(steps, axis=1).sum())
        if spline.use_cyclic_u:
            length += float(np.linalg.norm(points[0] - points[-1]))
    return length


def digest_of_curve(curve: bpy.types.Curve) -> str:
    """Another text for splines through other points."""
    return digest_of_points(_positions(curve))


def digest_of_points(arrays: list[np.ndarray]) -> str:
    """Another text for other arrays."""
    digest = hashlib.blake2b(digest_size=8)
    for values in arrays:
        for begin, end in blocks(len(values)):
            digest.update(np.ascontiguousarray(values[begin:end]))
    return digest.hexdigest()
