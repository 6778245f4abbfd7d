# SPDX-License-Identifier: GPL-3.0-or-later
"""One run as Blender sees it: what to solve, a preview while it grows, and how it ends.

A session keeps names and arrays, never references to Blender's data: those die with undo, with
deletion and with a new file. The growing curve is no data of Blender's at all, and a result that is
continued lays its own aside meanwhile, so that a run that is cancelled leaves everything as it was.
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from bpy.app.handlers import persistent

from . import (
    blender_data,
    blender_preparation,
    core,
    point_attributes,
    profile,
    properties,
    strand_data,
    strands,
    toolpath,
)
from .blender_alignment import alignment_of, directions_of
from .blender_data import DataError
from .blender_density import choice_of, density_of
from .blender_terms import terms_of
from .growing_curve import GrowingCurve
from .pace import Pace
from .preparation import described
from .stepper import Problem, Snapshot, Stepper
from .thinning import kept_points, merge_distance, thinned

TICKS_PER_SECOND = 15
KEYS = "Enter: Stop and Keep    Esc or Right Mouse: Cancel"
# Of the share that drawing may have where the processors draw, for the sidebar between pictures.
PANEL_SHARE = 0.15
# Nobody reads the status bar and the sidebar faster than they change, in seconds.
TEXT_INTERVAL = 0.25
# A copy of the curve that may have waited for longer than this, in seconds, since nobody looked, is
# not worth showing: the next one is an iteration away.
STALE = 0.25
# How far above the surface the preview is drawn, in spacings.
PREVIEW_LIFT = 0.05
# So many gaps are kept with a result, the largest: a run that was stopped early has thousands.
MOST_GAPS = 200


@dataclass(frozen=True)
class Key:
    """How to find an object again: a name, and the library that a linked one comes from."""

    name: str
    library: str | None

    @classmethod
    def of(cls, object: bpy.types.Object) -> Key:
        return cls(object.name, object.library.filepath if object.library else None)

    def find(self) -> bpy.types.Object | None:
        return bpy.data.objects.get((self.name, self.library))


@dataclass(frozen=True)
class Plan:
    """Everything that a run needs to know of the scene, read once when it begins."""

    problem: Problem
    surface: Key
    settings: Key  # whose settings were used: the surface or the result
    result: Key | None  # the result to continue or to fill anew; None makes a new one
    matrix: np.ndarray  # of the surface
    spacing: float
    bevel_depth: float  # world units
    parts: tuple[strands.Part, ...]  # what the seed was put together from
    dress: strand_data.Dress  # materials of the splines
    name: str  # of a new result
    loose_edges: int = 0  # of the surface, in no face
    flat: bool = False  # tilt for profiles that lie on the surface
    radius_follows: bool = False
    points_as: str = "NONE"  # a second object of all points: one of point_attributes.KINDS


def plan_run(context: bpy.types.Context, restart: bool = False) -> Plan:
    """Reads the scene for a run on the active object: a mesh, or a result to go on with.

    restart   start a result from the seed again, not from its own splines

    Raises DataError or core.MeanderError with a sentence for what cannot be used.
    """
    active = context.active_object
    surface = properties.surface_of(active)
    if surface is None:
        raise DataError("Choose a mesh to fill, or a curve that Meander has made")
    if context.scene not in surface.users_scene[:]:
        raise DataError(
            f"The surface '{surface.name}' is not in this scene any more; choose a mesh to fill"
        )
    settings = active.meander
    point_attributes.refuse(settings.points_as)
    options = core.default_options(settings.preset.lower())
    depsgraph = context.evaluated_depsgraph_get()
    vertices, faces = blender_data.triangles_of(surface, depsgraph)
    # As stored, so that a run that proposes its spacing and one that is given it are the same.
    spacing = settings.spacing or float(np.float32(blender_data.proposed_spacing(vertices, faces)))
    density = density_of(choice_of(settings), surface, depsgraph, spacing / 2.0)
    alignment = alignment_of(settings)
    directions = directions_of(alignment, surface, depsgraph, spacing / 2.0)
    parts, dress = strand_data.parts_of(active, depsgraph, restart)
    seed = strands.assembled(parts, settings.seed_every_part)
    surface_options = blender_preparation.surface_options(
        blender_preparation.repair_of(settings),
        blender_preparation.mask_of(settings),
        surface,
        depsgraph,
    )
    options.radius = spacing / 2.0
    terms_of(settings).apply(options)
    options.alignment_weight = alignment.weight if directions is not None else 0.0
    options.border_distance = float(f"{settings.border_distance:.6g}")  # 0.5 exactly
    options.threads = settings.threads
    options.medial_axis = core.MedialAxis[settings.medial_axis]
    outline = 0.0
    if settings.use_outline and _wants_outline(active, surface, restart):
        outline = options.border_distance * spacing
        if options.border_distance < 0.1:
            raise DataError("An outline needs a border distance of 0.1 or more; raise it")
    if settings.iteration_limit:
        options.iteration_limit = settings.iteration_limit
    return Plan(
        problem=Problem(
            vertices,
            faces,
            options,
            seed,
            density,
            surface_options,
            directions,
            alignment.kind,
            outline,
        ),
        surface=Key.of(surface),
        settings=Key.of(active),
        result=Key.of(active) if active is not surface else None,
        matrix=blender_data.world_matrix(surface.evaluated_get(depsgraph)),
        spacing=spacing,
        bevel_depth=settings.bevel_share * spacing if settings.use_bevel else 0.0,
        parts=tuple(parts),
        dress=dress,
        name=f"{(settings.seed or surface).name} Meander",
        loose_edges=blender_preparation.loose_edge_count(surface, depsgraph),
        flat=settings.flat_profile,
        radius_follows=settings.radius_follows,
        points_as=settings.points_as,
    )


def _wants_outline(active: bpy.types.Object, surface: bpy.types.Object, restart: bool) -> bool:
    """Whether a run lays the outline anew: a result that has kept it goes on with its own."""
    if active is surface or restart or not active.meander.figures.guides:
        return True
    if active.meander.guides is not None or active.meander.guide_collection is not None:
        raise DataError(
            f"'{active.name}' has drawn guides and an outline, which cannot be told apart; use "
            "Start Over"
        )
    return False


class _Window:
    """What a run borrows from the window: a timer, the status bar, the progress at the cursor.

    On a machine where drawing takes too much from the solver also the smoothing of edges, for which
    Blender would draw every picture eight times.
    """

    def __init__(self, context: bpy.types.Context) -> None:
        manager = context.window_manager
        self._timer = manager.event_timer_add(1.0 / TICKS_PER_SECOND, window=context.window)
        self._workspaces: set[str] = set()
        self._shown = ("", "")
        self._text_shown = 0.0  # when
        self._software = _draws_by_software()
        self._paces = {
            region: Pace(1.0 / TICKS_PER_SECOND, os.cpu_count() or 1, self._software)
            for region in ("WINDOW", "UI")
        }
        if self._software:
            # The sidebar itself is quick, but the whole window is put together anew for it.
            self._paces["UI"].share *= PANEL_SHARE
        self._smoothing: str | None = None
        self._handlers = {
            region: bpy.types.SpaceView3D.draw_handler_add(
                self._drawn, (region,), region, "POST_PIXEL"
            )
            for region in self._paces
        }
        manager.progress_begin(0.0, 100.0)

    def picture_due(self) -> bool:
        """Whether the curve may be shown anew without taking too much from the solver."""
        pace = self._paces["WINDOW"]
        due = pace.tick(time.perf_counter(), time.thread_time())
        if pace.slow and self._smoothing is None:
            self._smoothing = self._smooth("OFF")
        return due

    def picture_given(self) -> None:
        self._redraw("WINDOW")
        self._paces["WINDOW"].asked(time.perf_counter())

    def text_due(self, with_picture: bool) -> bool:
        """Whether the text may be shown anew; together with a picture it costs next to nothing."""
        now = time.perf_counter()
        due = self._paces["UI"].tick(now, time.thread_time())
        return (due or with_picture) and now >= self._text_shown + TEXT_INTERVAL

    def show(self, context: bpy.types.Context, text: str, progress: float) -> None:
        """Shows how far the run is, in the status bar and in panels."""
        # The text belongs to the workspace in front, and the user may change to another.
        self._workspaces.add(context.workspace.name)
        shown = (context.workspace.name, text)
        if shown == self._shown:
            return
        self._shown = shown
        self._text_shown = time.perf_counter()
        context.window_manager.progress_update(100.0 * progress)
        context.workspace.status_text_set(f"{text}    |    {KEYS}")
        self._redraw("UI")
        if not self._paces["WINDOW"].waiting:
            self._paces["UI"].asked(self._text_shown)

    def give_back(self) -> None:
        context = bpy.context
        for region, handler in self._handlers.items():
            bpy.types.SpaceView3D.draw_handler_remove(handler, region)
        if self._smoothing is not None:
            self._smooth(self._smoothing)
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        for name in self._workspaces:
            workspace = bpy.data.workspaces.get(name)
            if workspace is not None:
                with context.temp_override(workspace=workspace):
                    workspace.status_text_set(None)
        self._redraw("WINDOW")
        self._redraw("UI")

    def _drawn(self, region: str) -> None:
        self._paces[region].drawn(time.perf_counter())

    @staticmethod
    def _smooth(choice: str) -> str:
        """Chooses how edges are smoothed and returns what was chosen before."""
        preferences = bpy.context.preferences
        before, dirty = preferences.system.viewport_aa, preferences.is_dirty
        preferences.system.viewport_aa = choice
        preferences.is_dirty = dirty  # or Blender would save it
        return before

    @staticmethod
    def _redraw(kind: str) -> None:
        """The views, or the sidebars beside them."""
        for window in bpy.context.window_manager.windows:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    for region in area.regions:
                        if region.type == kind:
                            region.tag_redraw()


def _draws_by_software() -> bool:
    """Whether the processors draw, for want of a graphics card."""
    if bpy.app.background:
        return False
    import gpu  # asking it crashes without a window

    renderer = gpu.platform.renderer_get().lower()
    return any(name in renderer for name in ("llvmpipe", "softpipe", "swr", "swiftshader"))


class Session:
    """A run from its plan to its end.

    In a window: start(), then tick() at every timer event while it returns True, then keep() or
    not. Without: stepper.run(), then keep(). In any case, and last: end().
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.stepper = Stepper(plan.problem)
        self.latest: Snapshot | None = None
        self._shown = True  # whether the view has what is in `latest`
        self._looked = 0.0  # when a copy of the curve was last asked for
        self._looked_away = False  # whether a tick has passed since
        self._stale = False  # whether `latest` was old when it was taken
        self.stop_wanted = False
        self.ended = False
        self._window: _Window | None = None
        self._growing: GrowingCurve | None = None
        self._scene = ""  # name of the scene that shows it
        self._original_data = ""  # name of the data of a result that is continued
        self._emptied_data = ""  # and of what it has meanwhile

    def start(self, context: bpy.types.Context) -> None:
        """Begins the run, which goes on by itself, with a timer for tick()."""
        global _current
        _current = self
        self._scene = context.scene.name
        self._window = _Window(context)
        self.stepper.start()
        self._looked = time.perf_counter()

    def tick(self, context: bpy.types.Context) -> bool:
        """Shows how far the run is. False when it has come to its end.

        Raises DataError when the surface or the result has been deleted meanwhile.
        """
        self._check_alive()
        if self.stop_wanted:
            self.stepper.cancel()
        picture_due = self._window.picture_due()
        text_due = self._window.text_due(picture_due)
        # The run stands still while it makes a copy, so none is asked for in vain.
        if picture_due or text_due:
            self._look()
        else:
            self._looked_away = True
        if picture_due and not (self._shown or self._stale or self.stepper.finished):
            self._show(self.latest.polylines)
            self._shown = True
            self._window.picture_given()
        if text_due:
            self._window.show(context, self.progress_text(), self.progress())
        return not self.stepper.finished

    def _look(self) -> None:
        """Takes the newest copy of the curve if there is one, and has the run make another."""
        snapshot = self.stepper.poll()
        before, self._looked = self._looked, time.perf_counter()
        if snapshot is not None:
            self.latest = snapshot
            self._shown = False
            # It was made after the last look, perhaps right after.
            self._stale = self._looked_away and self._looked - before > STALE
        self._looked_away = False

    def progress(self) -> float:
        """How much of its expected length the curve has, in [0, 1]."""
        return self.latest.progress if self.latest is not None else 0.0

    def progress_text(self) -> str:
        """How far the run is, in words."""
        if self.latest is None:
            return "Preparing the surface"
        return f"{100.0 * self.progress():.0f} % grown, iteration {self.latest.iterations}"

    def remember_problem(self, context: bpy.types.Context, error: Exception) -> None:
        """Keeps the element that an error names with the surface, for Select Problem."""
        surface = self.plan.surface.find()
        if surface is not None and isinstance(error, core.MeanderError):
            blender_preparation.remember_problem(
                error, surface, context.evaluated_depsgraph_get()
            )

    def preparation_text(self) -> str:
        """What was done to the mesh, in words; empty if nothing was."""
        if not self.stepper.surface_figures:
            return ""
        return described(self.stepper.surface_figures, self.plan.loose_edges)

    def keep(self, context: bpy.types.Context) -> tuple[bpy.types.Object, dict[str, Any]]:
        """Waits for the end of the run and makes what has grown the result.

        Returns the curve object and the figures of the run. Raises what went wrong in the run.
        """
        try:
            snapshot, statistics, stop_reason = self.stepper.result()
        except core.MeanderError as error:
            self._check_alive()
            named = blender_data.in_polygons(
                error, self.plan.surface.find(), context.evaluated_depsgraph_get()
            )
            raise strands.explained(named, self.plan.parts) from error
        self._check_alive()
        self._end_preview()
        plan = self.plan
        surface = plan.surface.find()
        blender_preparation.forget_problem(surface)
        distance = merge_distance(plan.problem.options.radius, self.stepper.density)
        kept = kept_points(snapshot.polylines, distance)
        curve = thinned(snapshot.polylines, distance)
        result = blender_data.write_curve(
            curve,
            surface,
            plan.name,
            curve_object=plan.result.find() if plan.result else None,
            matrix=plan.matrix,
            bevel_depth=plan.bevel_depth,
        )
        radius = plan.problem.options.radius
        data = self.stepper.point_data
        factors = profile.room_factors(data.radii[kept], radius)
        profile.dress_points(
            result.data, curve, plan.matrix, plan.flat, factors if plan.radius_follows else None
        )
        strand_data.put_on(result.data, plan.dress)
        self._store(surface, result, statistics, self.stepper.gaps, stop_reason)
        guides, keep_guides = self.stepper.guides, result.meander.keep_guides
        strand_data.note_guides(result, guides, keep_guides)
        grown = strands.points_without_guides(curve, guides) if not keep_guides else slice(None)
        point_attributes.remember_room(result, data.radii[kept][grown], plan.matrix)
        if plan.points_as != "NONE":
            self._make_points(surface, result, snapshot.polylines, data)
        _select_only(context, result)
        return result, statistics

    def _make_points(
        self,
        surface: bpy.types.Object,
        result: bpy.types.Object,
        polylines: core.Polylines,
        data: core.PointData,
    ) -> None:
        """Makes the object of all points beside the result, instead of the last run's."""
        every = toolpath.strands_of(polylines, data)
        if not result.meander.keep_guides:
            flags = self.stepper.guides
            every = [strand for strand, is_guide in zip(every, flags) if not is_guide]
        earlier = result.meander.figures.points
        if earlier is not None and earlier.library is None:
            bpy.data.batch_remove([earlier, earlier.data])
        result.meander.figures.points = point_attributes.make(
            self.plan.points_as,
            f"{result.name} Points",
            every,
            surface,
            self.plan.matrix,
            self.plan.bevel_depth,
        )

    def end(self) -> None:
        """Ends the run, gives back what it borrowed, and takes away what keep() has not kept.

        May be called at any time and more than once.
        """
        global _current
        if self.ended:
            return
        self.ended = True
        if _current is self:
            _current = None
        self.stepper.cancel()
        self.stepper.join()
        if self._window is not None:
            self._window.give_back()
        self._end_preview()

    def _check_alive(self) -> None:
        if self.plan.surface.find() is None:
            raise DataError("The surface was deleted while the curve was growing; start again")
        if self.plan.result is not None and self.plan.result.find() is None:
            raise DataError("The curve was deleted while it was growing; start again")

    # -- preview -----------------------------------------------------------------------------

    @property
    def shown_points(self) -> int:
        """How many points the curve has that the views show."""
        return self._growing.point_count if self._growing is not None else 0

    def _show(self, polylines: core.Polylines) -> None:
        if self._growing is None:
            self._growing = GrowingCurve(self.plan.surface.find, self._scene, self.plan.matrix)
        self._hide_result()
        self._growing.show(polylines, PREVIEW_LIFT * self.plan.spacing)

    def _hide_result(self) -> None:
        """Empties a result that is continued while its curve is drawn."""
        result = self.plan.result.find() if self.plan.result else None
        if result is None or self._emptied_data:
            return
        self._original_data = result.data.name
        result.data = result.data.copy()
        result.data.bevel_depth = 0.0
        result.data.splines.clear()
        self._emptied_data = result.data.name

    def restore_result(self) -> None:
        """Gives a result that is continued its curve back, until the next picture."""
        if not self._emptied_data:
            return
        result = self.plan.result.find()
        original = bpy.data.curves.get(self._original_data)
        if result is not None and original is not None:
            result.data = original
        data = bpy.data.curves.get(self._emptied_data)
        if data is not None and data.users == 0:
            bpy.data.curves.remove(data)
        self._emptied_data = ""

    def _end_preview(self) -> None:
        if self._growing is not None:
            self._growing.remove()
            self._growing = None
        self.restore_result()

    # -- result ------------------------------------------------------------------------------

    def _store(
        self,
        surface: bpy.types.Object,
        result: bpy.types.Object,
        statistics: dict[str, Any],
        gaps: core.Gaps | None,
        stop_reason: str,
    ) -> None:
        """Writes the settings and the figures of the run to the result, and to whoever asked."""
        source = self.plan.settings.find()
        if source is None:
            source = result
        targets = {source.name: source, result.name: result}.values()
        if source != result:
            properties.copy_settings(source.meander, result.meander)
        result.meander.surface = surface
        for target in targets:
            if target.library is not None:  # linked objects cannot be changed
                continue
            target.meander.spacing = self.plan.spacing
            figures = target.meander.figures
            figures.stop_reason = stop_reason
            figures.nodes = int(statistics["nodes"])
            figures.iterations = int(statistics["iterations"])
            figures.length = float(statistics["length"])
            figures.spacing_median = float(statistics["spacing_median"])
            figures.seconds = float(statistics["seconds_total"])
            figures.empty_parts = int(statistics["empty_components"])
            figures.preparation = self.preparation_text()
            self._store_gaps(figures, gaps, target == result)

    def _store_gaps(
        self, figures: properties.MeanderFigures, gaps: core.Gaps | None, on_result: bool
    ) -> None:
        """None: nobody has looked for them, which a count of -1 says."""
        figures.gap_count = -1 if gaps is None else len(gaps)
        figures.largest_gap = float(gaps.sizes[0]) if gaps else 0.0
        figures.gaps.clear()
        if gaps is None or not on_result:  # positions mean nothing beside another object's curve
            return
        positions = blender_data.to_local(gaps.positions[:MOST_GAPS], self.plan.matrix)
        for position, size in zip(positions.tolist(), gaps.sizes.tolist()):
            gap = figures.gaps.add()
            gap.position = position
            gap.size = size


def _select_only(context: bpy.types.Context, object: bpy.types.Object) -> None:
    """Makes the object active and the only one selected, as Blender does with what it adds.

    Not while painting weights: the user goes on painting on the surface.
    """
    view_layer = context.view_layer
    if context.mode != "OBJECT" or view_layer.objects.get(object.name) != object:
        return
    for other in list(context.selected_objects):
        other.select_set(False)
    object.select_set(True)
    view_layer.objects.active = object


# The session that is going. There is one at most: it has the status bar and the Esc key.
_current: Session | None = None


def current() -> Session | None:
    """The session that is going, or None."""
    return _current


def end_current() -> None:
    """Ends the session that is going, if there is one, and restores what was there before it."""
    if _current is not None:
        _current.end()


@persistent
def _before_load(*_arguments: object) -> None:
    end_current()


@persistent
def _before_save(*_arguments: object) -> None:
    if _current is not None:
        _current.restore_result()  # what is saved is the curve, not the gap that it has left


def register() -> None:
    bpy.app.handlers.load_pre.append(_before_load)
    bpy.app.handlers.save_pre.append(_before_save)


def unregister() -> None:
    end_current()
    bpy.app.handlers.load_pre.remove(_before_load)
    bpy.app.handlers.save_pre.remove(_before_save)
