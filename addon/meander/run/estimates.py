# SPDX-License-Identifier: GPL-3.0-or-later
"""What the next run on an object comes to, for the panel and for the question before a large one.

The area of a surface is measured once, and again when its shape or what the density follows has
changed; the figures for another spacing are arithmetic. A panel never measures: it orders, and a
timer does it as soon as the window has nothing else to do.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import bpy
from bpy.app.handlers import persistent

from .. import core
from ..model.estimate import Estimate, Speeds, estimated, extent_of
from ..model.field import evaluated
from ..scene.density import chosen_density, density_of
from ..scene.errors import DataError
from ..scene.flow_options import options_of
from ..scene.identity import Key
from ..scene.meshes import area_of, spacing_for, triangles_of
from ..scene.preparation import mask_of, repair_of, surface_options
from ..scene.settings import surface_of
from .meaning import Meaning, meaning_of
from .plan import Plan
from .window import redraw

# Of the time, while a shape changes all the time, that measuring it may take.
_SHARE = 0.1
# The setting whose changes need no new measuring.
_ARITHMETIC = "spacing"

speeds = Speeds()


@dataclass(frozen=True)
class _Measured:
    meaning: Meaning
    extent: core.Extent | None  # None: the object cannot be filled as it is
    automatic: float  # the spacing that 0 stands for


_measured: _Measured | None = None
_ordered: Key | None = None
_next = 0.0  # when the next measuring may begin


def shown(active: bpy.types.Object) -> Estimate | None:
    """What a run on an object comes to, as far as it is known; what is not known yet is ordered.

    Cheap, for panels; the sidebars are redrawn when there is more to show.
    """
    meaning = meaning_of(active)
    if meaning is None:
        return None
    if _measured is None or not meaning.same_as(_measured.meaning, _ARITHMETIC):
        _order(active)
        if _measured is None or _measured.meaning.shape[0] != meaning.shape[0]:
            return None  # of another surface
    if _measured.extent is None:
        return None
    settings = active.meander
    try:
        options = options_of(settings, settings.spacing or _measured.automatic)
        return estimated(_measured.extent, options, settings.use_bevel, speeds)
    except core.MeanderError:  # the button says why
        return None


def of_plan(plan: Plan) -> Estimate:
    """What a run comes to that has been planned. Raises core.MeanderError for a mesh at fault."""
    problem = plan.problem
    extent = _extent(
        problem.vertices, problem.faces, problem.density, problem.surface_options, problem.options
    )
    return estimated(extent, problem.options, plan.look.radius > 0.0, speeds)


def _order(active: bpy.types.Object) -> None:
    global _ordered
    _ordered = Key(active)
    if not bpy.app.background and not bpy.app.timers.is_registered(_measure_ordered):
        wait = max(0.0, _next - time.perf_counter())
        bpy.app.timers.register(_measure_ordered, first_interval=wait)


def _measure_ordered() -> None:
    global _next
    begin = time.perf_counter()
    active = _ordered.find() if _ordered is not None else None
    if active is not None and active == bpy.context.view_layer.objects.active:
        measure(active)
    end = time.perf_counter()
    _next = end + (end - begin) / _SHARE
    redraw("UI")


def measure(active: bpy.types.Object) -> None:
    """Measures the surface of an object, so that shown() knows it."""
    global _measured
    meaning = meaning_of(active)
    if meaning is None:
        return
    extent, automatic = None, 0.0
    try:
        surface, settings = surface_of(active), active.meander
        depsgraph = bpy.context.evaluated_depsgraph_get()
        vertices, faces = triangles_of(surface, depsgraph)
        automatic = spacing_for(area_of(vertices, faces))
        options = options_of(settings, settings.spacing or automatic)
        density = density_of(chosen_density(settings, surface), surface, depsgraph, options.radius)
        mended = repair_of(settings).options(vertices, options.radius)
        prepared = surface_options(mended, mask_of(settings), surface, depsgraph)
        extent = _extent(vertices, faces, density, prepared, options)
    except (DataError, core.MeanderError):
        pass  # the button says what is wrong
    _measured = _Measured(meaning_of(active), extent, automatic)


def _extent(vertices, faces, density, prepared, options) -> core.Extent:
    share = 1.0
    if callable(density) or prepared.face_mask is not None or prepared.vertex_mask is not None:
        with core.Surface(vertices, faces, prepared, options.threads) as surface:
            share = surface.statistics()["area"] / area_of(vertices, faces)
            density = evaluated(density, surface)
    return extent_of(vertices, faces, density, share)


@persistent
def _on_load(*_arguments: object) -> None:
    global _measured, _ordered
    _measured = _ordered = None


def register() -> None:
    bpy.app.handlers.load_post.append(_on_load)


def unregister() -> None:
    bpy.app.handlers.load_post.remove(_on_load)
    if bpy.app.timers.is_registered(_measure_ordered):
        bpy.app.timers.unregister(_measure_ordered)
    _on_load()
