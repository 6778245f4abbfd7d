# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel "Meander" in the sidebar of the 3D viewport."""

from __future__ import annotations

import bpy
from bpy.props import FloatProperty

from ..model import last_run
from ..model.empty import Empty, percent
from ..model.estimate import described
from ..model.options.table import in_panel
from ..run import estimate as estimates
from ..run import gaps as gap_marks
from ..run import session
from ..run.queue import objects_of
from ..scene.blender_versions import draw_progress
from ..scene.fillable import is_result, why_not_this
from ..scene.lengths import length_text
from ..scene.linked_settings import can_be_changed, settings_of
from ..scene.made import made_from
from ..scene.results import shown_result
from ..scene.settings import surface_of
from .declared import row, rows, switch
from .drawing import surface_drawn_on
from .fill import MEANDER_OT_stop, draw_fill_buttons, seeded_mesh
from .gaps import MEANDER_OT_show_gaps, wide_gaps
from .help import MEANDER_OT_open_help
from .made import MEANDER_OT_select_curve, draw_hidden, draw_made
from .on_result import LINKED, is_linked
from .operators import MEANDER_OT_choose_settings, MEANDER_OT_propose_spacing
from .preparation import draw_faults
from .presets import MEANDER_PT_presets, active_name
from .registered import registration
from .rendered import draw_rendering
from .settings import MeanderFigures, MeanderSettings
from .sidebar import ADVANCED, GUIDANCE, ORDER, OUTPUT, Sidebar, SubPanel, columns, notice


class MEANDER_PT_main(Sidebar, bpy.types.Panel):
    bl_idname = "MEANDER_PT_main"
    bl_label = "Meander"

    def draw_header_preset(self, _context: bpy.types.Context) -> None:
        row = self.layout.row(align=True)
        row.emboss = "NONE"
        row.popover(panel=MEANDER_PT_presets.__name__, icon="PRESET", text="")
        row.operator(MEANDER_OT_open_help.bl_idname, icon="QUESTION", text="")

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        running = session.current()
        surface = surface_of(context.active_object)
        if surface is not None:
            _draw_linked(layout, context.active_object)
            self._draw_settings(layout.column(), context.active_object, surface)
        elif made_from(context.active_object) is not None:
            draw_made(layout, made_from(context.active_object), context.active_object)
        elif running is not None or surface_drawn_on(context.active_object) is not None:
            pass
        elif seeded_mesh(context) is not None:
            self._draw_seed(layout, context)
        else:
            notice(layout, why_not_this(context.active_object) or "Select a mesh to fill")
        if running is not None:
            self._draw_progress(layout, context, running)
        elif surface is not None:
            draw_hidden(layout, context)
            draw_rendering(layout, context)
            self._draw_buttons(layout, context)
            draw_faults(layout, context)

    def _draw_settings(
        self, layout: bpy.types.UILayout, active: bpy.types.Object, surface: bpy.types.Object
    ) -> None:
        settings: MeanderSettings = settings_of(active)
        layout.use_property_split = True
        layout.use_property_decorate = False
        # Which surface it is, and lies on, is a fact, not a choice; its name has all the room.
        row = layout.row()
        row.label(text=surface.name, icon="MESH_DATA")
        if not active.select_get() or active == surface:
            _draw_select_curve(row, active)
        _labelled(layout, "Preset").popover(
            panel=MEANDER_PT_presets.__name__, text=active_name(settings) or "Custom"
        )
        live = layout.column()
        columns(live, live=True)
        row = live.row(align=True)
        row.prop(settings, "spacing")
        row.operator(MEANDER_OT_propose_spacing.bl_idname, text="", icon="SHADERFX")
        switch(live, settings, "live")

    def _draw_seed(self, layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
        """What there is to do with a curve that is the seed of a mesh: fill that."""
        layout.label(text=seeded_mesh(context).name, icon="MESH_DATA")
        layout.operator_context = "INVOKE_DEFAULT"
        column = layout.column(align=True)
        column.scale_y = 1.4
        draw_fill_buttons(column, context)

    def _draw_buttons(
        self, layout: bpy.types.UILayout, context: bpy.types.Context
    ) -> None:
        active = context.active_object
        layout.operator_context = "INVOKE_DEFAULT"
        column = layout.column(align=True)
        column.scale_y = 1.4
        draw_fill_buttons(column, context)
        objects = objects_of(context)
        if settings_of(active).spacing == 0.0:
            layout.label(text=_automatic(context, objects), icon="INFO")
        if len(objects) > 1:
            layout.label(text=f"{len(objects)} objects", icon="OUTLINER_OB_MESH")
        # The same row from the first moment on, so that the panel does not jump.
        estimate = estimates.shown(objects)
        row = layout.row()
        row.active = False
        row.label(text=described(estimate) if estimate is not None else "")

    def _draw_progress(
        self, layout: bpy.types.UILayout, context: bpy.types.Context, running: session.Session
    ) -> None:
        column = layout.column(align=True)
        if not running.is_about(context.active_object):
            grows = running.plan.surface.find()
            column.label(text=grows.name if grows is not None else "", icon="MESH_DATA")
        if not draw_progress(column, running.bar(), running.progress_text()):
            bar = column.column()
            bar.enabled = False
            phase = running.phase_text()
            bar.prop(context.window_manager, "meander_progress", text=phase, slider=True)
        row = column.row()
        row.scale_y = 1.4
        row.operator(MEANDER_OT_stop.bl_idname, icon="SNAP_FACE")
        # The same rows from the first moment on, so that the panel does not jump.
        latest = running.latest
        _figures(
            layout,
            (
                ("Time Left", running.left_text()),
                ("Points", f"{latest.nodes:,}" if latest else ""),
                ("Length", length_text(context.scene, latest.length, 4) if latest else ""),
            ),
        )


class MEANDER_PT_guidance(SubPanel, bpy.types.Panel):
    """Where the line runs, how close and which way: symmetry, and what stands below it."""

    bl_idname = GUIDANCE
    bl_label = "Guidance"
    bl_order = ORDER["guidance"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        settings = settings_of(context.active_object)
        layout.row(align=True).prop(settings, "mirror", expand=True)
        if settings.mirror != "NONE":
            layout.prop(settings, "hide_seam")


class MEANDER_PT_output(SubPanel, bpy.types.Panel):
    """What is made of the line: what stands below it."""

    bl_idname = OUTPUT
    bl_label = "Output"
    bl_order = ORDER["output"]

    def draw(self, _context: bpy.types.Context) -> None:
        pass


class MEANDER_PT_advanced(SubPanel, bpy.types.Panel):
    bl_idname = ADVANCED
    bl_label = "Advanced"
    bl_order = ORDER["advanced"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        settings = settings_of(context.active_object)
        rows(layout, settings, "Advanced")
        for option in in_panel("Preferences"):
            if getattr(settings, option.setting):  # by a script: it comes before the preferences
                row(layout, settings, option.setting)


class MEANDER_PT_figures(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_figures"
    bl_label = "Last Run"
    bl_order = ORDER["last_run"]
    bl_options = set()  # open

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        active = context.active_object
        if session.current() is not None or surface_of(active) is None:
            return False
        result = shown_result(active, context.scene)
        return result is not None and bool(result.meander.figures.stop_reason)

    def draw(self, context: bpy.types.Context) -> None:
        result = shown_result(context.active_object, context.scene)
        figures = result.meander.figures
        layout = self.layout
        if figures.stop_reason in last_run.ENDED:
            notice(layout, last_run.ENDED[figures.stop_reason])
        if last_run.is_rough(figures.smoothing, figures.stretch):
            notice(layout, last_run.ROUGH)
        if figures.lines:
            column = layout.column(align=True)
            column.label(text=last_run.lines(figures.lines, figures.closed_lines))
            notice(column, figures.lines_why, "NONE")
        if figures.began:
            notice(layout, figures.began)
        if figures.empty_parts:
            notice(layout, "Parts remain empty", "ERROR")
        gaps = wide_gaps(figures)
        _figures(
            layout,
            (
                *_evenness(figures),
                *_emptiness(figures, gaps),
                ("Median Spacing", length_text(context.scene, figures.spacing_median, 4)),
                ("Length", length_text(context.scene, figures.length, 4)),
                ("Time", f"{figures.seconds:.1f} s"),
            ),
        )
        if gaps > 0:
            layout.operator(
                MEANDER_OT_show_gaps.bl_idname,
                text="Hide Gaps" if gap_marks.shown_of(result) else "Show Gaps",
                icon="HIDE_OFF",
            )


def _draw_linked(layout: bpy.types.UILayout, active: bpy.types.Object) -> None:
    """Why settings are grey, and what helps, of what comes from another file."""
    if is_result(active) and is_linked(active):
        notice(layout, LINKED, "LIBRARY_DATA_DIRECT")
    elif not is_result(active) and not can_be_changed(active):
        layout.operator(MEANDER_OT_choose_settings.bl_idname, icon="LIBRARY_DATA_DIRECT")


def _draw_select_curve(row: bpy.types.UILayout, active: bpy.types.Object) -> None:
    """A fill selects nothing, as the outline of a curve so dense would cover it: one click does."""
    if shown_result(active, bpy.context.scene) is not None:
        select = MEANDER_OT_select_curve.bl_idname
        row.operator(select, text="", icon="RESTRICT_SELECT_OFF", emboss=False)


def _labelled(layout: bpy.types.UILayout, text: str) -> bpy.types.UILayout:
    """A row with a label, as settings have it; what it is of comes beside."""
    split = layout.split(factor=0.4)
    label = split.row()
    label.alignment = "RIGHT"
    label.label(text=text)
    return split


def _evenness(figures: MeanderFigures) -> tuple[tuple[str, str], ...]:
    return (("Even", last_run.evenness(figures.evenness)),) if figures.evenness >= 0.0 else ()


def _emptiness(figures: MeanderFigures, gaps: int) -> tuple[tuple[str, str], ...]:
    """A row at most: how much is empty where that is not filled, else how many gaps there are."""
    empty = Empty(figures.empty_share, figures.narrow_share)
    if empty.matters:
        return (("Empty", f"{percent(empty.share)} in {gaps:,}"),)
    if empty.narrow_matters:
        return (("Too Narrow", percent(empty.narrow)),)
    return (("Gaps", f"{gaps:,}"),) if gaps > 0 else ()


def _automatic(context: bpy.types.Context, objects: list[bpy.types.Object]) -> str:
    """What a spacing of 0 comes to."""
    if len(objects) > 1:
        return "Automatic for each"
    spacing = estimates.automatic(objects[0])
    if spacing <= 0.0:
        return "Automatic"
    return f"Automatic: {length_text(context.scene, spacing, 4)}"


def _figures(layout: bpy.types.UILayout, rows: tuple[tuple[str, str], ...]) -> None:
    column = layout.column(align=True)
    for name, value in rows:
        split = column.split(factor=0.58)
        left = split.row()
        left.alignment = "RIGHT"
        left.active = False
        left.label(text=name)
        split.label(text=value)


def _percent(_manager: bpy.types.WindowManager) -> float:
    running = session.current()
    # Rounded, since Blender shows the decimals of small values whatever the precision.
    return round(100.0 * running.bar()) if running is not None else 0.0


_register, _unregister = registration(
    MEANDER_PT_main,
    MEANDER_PT_figures,
    MEANDER_PT_guidance,
    MEANDER_PT_output,
    MEANDER_PT_advanced,
)


def register() -> None:
    # Not a setting, only something that a slider of Blender before 4.0 can show.
    bpy.types.WindowManager.meander_progress = FloatProperty(
        name="Progress", subtype="PERCENTAGE", min=0.0, max=100.0, precision=0, get=_percent
    )
    _register()


def unregister() -> None:
    _unregister()
    del bpy.types.WindowManager.meander_progress
