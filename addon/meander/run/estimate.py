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

from .. import core
from ..model.estimate import Estimate, Speeds, estimated, extent_of, together
from ..model.field import evaluated, evaluating
from ..model.options.option import as_typed
from ..model.problem import Problem
from ..model.steps import Background, Steps
from ..scene.density import chosen_density, density_of
from ..scene.errors import DataError
from ..scene.identity import Key, number_of
from ..scene.linked_settings import settings_of
from ..scene.meshes import triangles_of
from ..scene.options import options_of
from ..scene.preparation import mask_of, repair_of, surface_options
from ..scene.settings import is_untouched, surface_of
from . import stepper
from .lasting import Activity, Memory, why_busy
from .meaning import Meaning, meaning_of
from .plan import Plan
from .window import redraw

# Of the time, while a shape changes all the time, that measuring it may take.
_SHARE = 0.1
# When it is tried again, in seconds, after a run: its window is not to hang meanwhile.
_LATER = 0.5
# When it is looked, in seconds, whether what many faces come to is known.
_TICK = 0.05
# The setting whose changes need no new measuring.
_ARITHMETIC = "spacing"

speeds = Speeds()


@dataclass(frozen=True)
class _Measured:
    meaning: Meaning
    extent: core.Extent | None  # None: the object cannot be filled as it is
    automatic: float  # the spacing that 0 stands for


# By the number of the object whose settings count: at most _MOST, the newest last.
_measured: Memory[int, _Measured] = Memory()
_MOST = 256
# What is to be measured, by the number of the object, the first ordered first.
_ordered: Memory[int, Key] = Memory()


class _Pause:
    """Between two measurings, so that they take no more than their share of the time."""

    until = 0.0  # by time.perf_counter()


def shown(objects: list[bpy.types.Object]) -> Estimate | None:
    """What runs on objects come to, one after another, as far as all of them are known; what is not
    known yet is ordered.

    Those that nobody has set up take the choices of the first, as Queue has it. What cannot be
    filled counts for nothing. Cheap, for panels; the sidebars are redrawn when there is more to
    show.
    """
    estimates = []
    for thing in objects:
        found = _known(thing)
        if found is None and number_of(thing) not in _measured:
            return None
        own = settings_of(thing)
        settings = settings_of(objects[0]) if is_untouched(own) else own
        estimate = None if found is None else _estimate(found, settings)
        estimates += [] if estimate is None else [estimate]
    return together(estimates)


def automatic(active: bpy.types.Object) -> float:
    """The spacing that 0 stands for on an object; 0 while that is not known."""
    found = _known(active)
    return 0.0 if found is None else found.automatic


def expected(thing: bpy.types.Object | None) -> float | None:
    """The seconds that a run on an object was said to take; None where it was not measured."""
    meaning = meaning_of(thing)
    found = None if meaning is None else _measured.get(number_of(thing))
    if found is None or found.extent is None or not meaning.same_as(found.meaning, _ARITHMETIC):
        return None
    estimate = _estimate(found, settings_of(thing))
    return None if estimate is None else estimate.seconds


def _known(active: bpy.types.Object) -> _Measured | None:
    """What is known of an object that can be filled; orders what is not."""
    meaning = meaning_of(active)
    if meaning is None:
        return None
    found = _measured.get(number_of(active))
    if found is None or not meaning.same_as(found.meaning, _ARITHMETIC):
        _order(active)
        if found is None or found.meaning.shape[0] != meaning.shape[0]:
            return None  # of another surface
    return found if found.extent is not None else None


def _estimate(found: _Measured, settings: bpy.types.PropertyGroup) -> Estimate | None:
    try:
        options = options_of(settings, as_typed(settings.spacing) or found.automatic)
        symmetric = settings.mirror != "NONE"
        return estimated(found.extent, options, settings.use_bevel, speeds, symmetric)
    except core.MeanderError:  # the button says why
        return None


def of_plan(plan: Plan) -> Estimate:
    """What a run comes to that has been planned. Raises core.MeanderError for a mesh at fault."""
    problem, bevelled = plan.problem, plan.look.radius > 0.0
    symmetric = problem.mirror is not None
    return estimated(extent_of_problem(problem), problem.options, bevelled, speeds, symmetric)


def of_plan_or_none(plan: Plan) -> Estimate | None:
    """The same; None where the run will report why there is none."""
    try:
        return of_plan(plan)
    except core.MeanderError:
        return None


def extent_of_problem(problem: Problem) -> core.Extent:
    """What there is to fill. Raises core.MeanderError for a mesh at fault."""
    return _extent(
        problem.vertices, problem.faces, problem.density, problem.surface_options, problem.options
    )


def _order(active: bpy.types.Object) -> None:
    if _going.current is not None and _going.current.number == number_of(active):
        return  # if it has changed meanwhile, it is ordered when that is seen
    _ordered.setdefault(number_of(active), Key(active))
    if not bpy.app.background and not bpy.app.timers.is_registered(measure_ordered):
        wait = max(0.0, _Pause.until - time.perf_counter())
        bpy.app.timers.register(measure_ordered, first_interval=wait)


def measure_ordered() -> float | None:
    """Measures one of what is ordered, if it is still selected, or goes on with that; the rest at
    its next call. Nothing while a curve grows, whose panel shows what is left of that."""
    if why_busy() is not None:
        going = _going.current
        if going is not None:
            _ordered.setdefault(going.number, going.key)
            _going.end()
        return _LATER
    begin = time.perf_counter()
    thing = None if _going.lasts else _next_ordered()
    if thing is not None:
        _going.begin(_Going(thing))
    going = _going.current
    if going is not None:
        over = going.steps.go_on()
        end = time.perf_counter()
        going.spent += end - begin
        if not over:
            return _TICK
        _note(_going.taken())
        _Pause.until = end + going.spent / _SHARE
    redraw("UI")
    return max(0.0, _Pause.until - time.perf_counter()) if _ordered else None


def _next_ordered() -> bpy.types.Object | None:
    """The first of what is ordered that is still selected; those before it are forgotten."""
    view_layer = bpy.context.view_layer
    while _ordered:
        thing = _ordered.pop(next(iter(_ordered))).find()
        if thing is None or view_layer.objects.get(thing.name) != thing:
            continue
        if thing == view_layer.objects.active or thing.select_get():
            return thing
    return None


class _Going:
    """An object that is being measured.

    steps   come to a _Measured, or to None
    spent   seconds for which Blender has waited for them
    """

    def __init__(self, thing: bpy.types.Object) -> None:
        self.key, self.number, self.spent = Key(thing), number_of(thing), 0.0
        self.steps = Background(_measuring(self.key), core.Context())


_going: Activity[_Going] = Activity(lambda going: going.steps.end())


def measure(active: bpy.types.Object) -> None:
    """Measures the surface of an object at once, so that shown() knows it."""
    going = _Going(active)
    going.steps.go_on(wait=True)
    _note(going)


def _note(going: _Going) -> None:
    measured = going.steps.done
    if measured is None:
        return
    _measured.pop(going.number, None)
    _measured[going.number] = measured
    if len(_measured) > _MOST:
        del _measured[next(iter(_measured))]


def _measuring(key: Key) -> Steps[_Measured | None]:
    """Measures a surface. Of many faces with a pause where Blender has been read, and on a thread
    of the library's; None where the object has changed meanwhile, which orders it again."""
    active = key.find()
    meaning = meaning_of(active)
    if meaning is None:
        return None
    extent, automatic = None, 0.0
    try:
        vertices, faces = triangles_of(surface_of(active), bpy.context.evaluated_depsgraph_get())
        meaning = meaning_of(active)
        many = len(faces) >= stepper.MANY_FACES
        if many:
            yield None
        automatic = core.automatic_spacing(vertices, faces)
        if many:
            yield None
            active = key.find()
            if not meaning.same_as(meaning_of(active)):
                return None
        surface, settings = surface_of(active), settings_of(active)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        options = options_of(settings, as_typed(settings.spacing) or automatic)
        density = density_of(chosen_density(settings, surface), surface, depsgraph, options.radius)
        mended = repair_of(settings).options(vertices, options.radius)
        prepared = surface_options(mended, mask_of(settings), surface, depsgraph)
        if many:
            extent = yield from _beside(vertices, faces, density, prepared, options)
        else:
            extent = _extent(vertices, faces, density, prepared, options)
            meaning = meaning_of(active)
    except (DataError, core.MeanderError):
        pass  # the button says what is wrong
    return _Measured(meaning, extent, automatic)


def _beside(vertices, faces, density, prepared, options) -> Steps[core.Extent]:
    """_extent() on a thread of the library's."""
    made = yield core.Surface.work(vertices, faces, prepared, options.threads)
    with made as surface:
        density = yield from evaluating(density, surface)
        return (yield surface.extent_work(density))


def _extent(vertices, faces, density, prepared, options) -> core.Extent:
    share = 1.0
    masked = prepared is not None and (
        prepared.face_mask is not None or prepared.vertex_mask is not None
    )
    if callable(density) or masked:
        with core.Surface(vertices, faces, prepared, options.threads) as surface:
            share = surface.statistics()["area"] / core.area_of(vertices, faces)
            density = evaluated(density, surface)
    return extent_of(vertices, faces, density, share)
