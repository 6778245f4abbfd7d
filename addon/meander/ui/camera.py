# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what the scene's camera sees on a page: the dialog, and the runs that follow it."""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from ..model.camera import PAPERS, SPACING, CameraPage, Page
from ..model.estimate import Estimate, described
from ..model.options import tone
from ..model.options.option import as_typed
from ..model.picture.tone import Tone
from ..run.camera import CameraDrawing, Going
from ..run.camera import going as going_on
from ..run.lasting import why_busy
from ..run.paper import DrawingEstimate
from ..run.window import Window
from ..scene.blender_versions import ask
from ..scene.camera import camera_page
from ..scene.errors import DataError
from ..scene.linked_settings import settings_of
from ..scene.settings import surface_of
from .declared import share_of
from .file_names import file_named
from .fill import draw_question
from .preferences import is_large
from .reasons import Reasoned, Reasons, not_in_object_mode
from .refusing import refusing
from .registered import registration
from .ticked import KEYS, Ticked


def _papers() -> tuple[tuple[str, str, str], ...]:
    sizes = (
        (name.upper(), name.capitalize(), f"{width:g} x {height:g} mm")
        for name, (width, height) in PAPERS.items()
    )
    return (*sizes, ("CUSTOM", "Custom", "Width and Height"))


class PageSettings:
    """The page and what is drawn on it: settings of the drawing and of the question before it."""

    filepath: StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})
    spacing: FloatProperty(
        name="Spacing (mm)",
        description="Between neighbouring strands on paper, in millimetres, where a surface faces "
        "the camera; closer where it turns away",
        default=SPACING,
        min=0.05,
        soft_min=0.3,
        soft_max=20.0,
    )
    use_tone: BoolProperty(
        name="Tone of the Lamps",
        description="Draw as dark as the lamps of the scene make it: strands are as far apart as "
        "the line is wide over how dark it is, and Spacing does not count",
        default=False,
    )
    tone_kind: EnumProperty(
        name=tone.KIND.label,
        description=tone.KIND.tip,
        items=tuple((name.upper(), label, tip) for name, label, tip in tone.KIND.choices),
    )
    darkest: FloatProperty(**share_of(tone.DARKEST))
    lightest: FloatProperty(**share_of(tone.LIGHTEST))
    use_outlines: BoolProperty(
        name="Outlines",
        description="Draw where surfaces turn out of sight, their creases and edges as well, in "
        "layers of their own",
        default=False,
    )
    paper: EnumProperty(
        name="Paper",
        description="The page, which lies or stands as the camera's picture does",
        items=_papers(),
        default="A4",
    )
    width: FloatProperty(
        name="Width (mm)",
        description="Of the page, in millimetres",
        default=200.0,
        min=1.0,
        max=1e5,
    )
    height: FloatProperty(
        name="Height (mm)",
        description="Of the page, in millimetres",
        default=200.0,
        min=1.0,
        max=1e5,
    )
    margin: FloatProperty(
        name="Margin (mm)",
        description="On all sides of the page, in millimetres; the camera's picture is as large as "
        "that allows",
        default=15.0,
        min=0.0,
        soft_max=50.0,
    )
    line_width: FloatProperty(
        name="Line Width (mm)",
        description="Of the pen, in millimetres",
        default=0.3,
        min=0.001,
        soft_max=2.0,
    )
    report_too: BoolProperty(
        name="Report",
        description="Write what has become of each object beside it, as a JSON file",
        default=False,
    )


class MEANDER_OT_draw_camera(Reasoned, PageSettings, Ticked, bpy.types.Operator):
    """Fill everything that the camera sees at one spacing on paper, and write the page as an SVG
    file with a layer for each object, without what is hidden. Nothing in the scene is changed"""

    bl_idname = "meander.draw_camera"
    bl_label = "Draw from Camera"
    going_on = going_on

    filter_glob: StringProperty(default="*.svg", options={"HIDDEN", "SKIP_SAVE"})
    asked: BoolProperty(
        name="Asked",
        description="Begin without asking, however large the drawing is",
        default=False,
        options={"HIDDEN", "SKIP_SAVE"},
    )

    _size: DrawingEstimate | None = None  # of what the camera sees, for the dialog

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        yield why_busy()
        if context.scene.camera is None:
            yield "The scene has no camera"
        yield not_in_object_mode(context)

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        row = layout.row()
        row.active = not self.use_tone
        row.prop(self, "spacing")
        layout.prop(self, "use_tone")
        if self.use_tone:
            for name in ("tone_kind", "darkest", "lightest"):
                layout.prop(self, name)
        layout.prop(self, "use_outlines")
        layout.prop(self, "paper")
        if self.paper == "CUSTOM":
            column = layout.column(align=True)
            column.prop(self, "width")
            column.prop(self, "height")
        for name in ("margin", "line_width", "report_too"):
            layout.prop(self, name)
        expected = self._expected(context)
        if expected is not None:
            row = layout.row()
            row.active = False
            row.label(text=f"About {described(expected)}")

    def _expected(self, context: bpy.types.Context) -> Estimate | None:
        """What the page that is chosen comes to; None while that is not known."""
        if self._size is None or self.use_tone:
            return None
        try:
            return self._size.at(self.spacing, float(self._frame(context).sides[0]))
        except DataError:  # which drawing will report
            return None

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if not self.filepath:
            self.filepath = bpy.path.clean_name(context.scene.camera.name) + ".svg"
        if self.asked:
            return self.execute(context)
        try:
            self._size = self._drawing(context).estimate()
        except DataError:  # which drawing will report
            self._size = None
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        self.filepath = file_named(self.filepath, ".svg")
        drawing = self._drawing(context)
        if self.options.is_invoke and not bpy.app.background:
            if not self.asked and self._asks(drawing):
                return {"CANCELLED"}
            return self._watch(context, Going(drawing, None, Window(context, KEYS)))
        while (stepper := drawing.next()) is not None:
            stepper.run()
            drawing.take(stepper)
        self._write(context, drawing)
        return {"FINISHED"}

    def _asks(self, drawing: CameraDrawing) -> bool:
        """Whether so much is to be drawn that the user is asked; he begins it, or does not."""
        expected = drawing.estimate().at(drawing.spacing, float(drawing.page.sides[0]))
        if expected is None or not is_large(expected):
            return False
        chosen = {name: getattr(self, name) for name in PageSettings.__annotations__}
        bpy.ops.meander.ask_draw("INVOKE_DEFAULT", figures=described(expected), **chosen)
        return True

    def _frame(self, context: bpy.types.Context) -> CameraPage:
        sides = PAPERS.get(self.paper.lower(), (self.width, self.height))
        page = Page(*sides, self.margin)
        if not page.has_room:
            raise DataError("The margins leave nothing of the page; choose a smaller Margin")
        scene = context.scene
        return camera_page(scene, context.evaluated_depsgraph_get(), scene.camera, page)

    def _drawing(self, context: bpy.types.Context) -> CameraDrawing:
        active = context.active_object
        fallback = settings_of(active) if active and surface_of(active) == active else None
        depsgraph = context.evaluated_depsgraph_get()
        return CameraDrawing(
            self._frame(context),
            self.spacing,
            depsgraph,
            fallback,
            self._tone(),
            self.line_width,
            self.use_outlines,
        )

    def _tone(self) -> Tone | None:
        if not self.use_tone:
            return None
        darkest, lightest = as_typed(self.darkest), as_typed(self.lightest)
        return Tone(self.tone_kind.lower(), darkest, min(lightest, 0.9 * darkest))

    def _write(self, context: bpy.types.Context, drawing: CameraDrawing) -> None:
        path = Path(self.filepath).with_suffix(".svg")
        report = path.with_suffix(".json") if self.report_too else None
        told = drawing.write(path, self.line_width, context.scene.camera.name, report)
        self.report({"INFO"}, f"{path.name}: {told}")
        for remark in drawing.remarks():
            self.report({"WARNING"}, remark)

    def _tick(self, context: bpy.types.Context, going: Going) -> CameraDrawing | None:
        drawing = going.drawing
        if going.stepper is None or going.stepper.finished:
            if going.stepper is not None:
                drawing.take(going.stepper)
            going.stepper = drawing.next()
            if going.stepper is None:
                return drawing
            going.stepper.start()
        going.stepper.prepare()
        snapshot = going.stepper.poll()
        if snapshot is not None and going.window.text_due(False):
            text = f"{drawing.place}: {drawing.name}, {snapshot.progress:.0%}"
            going.window.show(context, text, snapshot.progress)
        return None


class MEANDER_OT_ask_draw(PageSettings, bpy.types.Operator):
    """Begin a drawing that is larger than the preferences allow without asking"""

    bl_idname = "meander.ask_draw"
    bl_label = "Draw a Large Page?"
    bl_options = {"INTERNAL"}

    figures: StringProperty(options={"HIDDEN", "SKIP_SAVE"})

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        return ask(context.window_manager, self, 340, "Draw")

    def draw(self, _context: bpy.types.Context) -> None:
        draw_question(self.layout, self.figures)

    def execute(self, _context: bpy.types.Context) -> set[str]:
        chosen = {name: getattr(self, name) for name in PageSettings.__annotations__}
        bpy.ops.meander.draw_camera("INVOKE_DEFAULT", asked=True, **chosen)
        return {"FINISHED"}


def _menu(self: bpy.types.Menu, _context: bpy.types.Context) -> None:
    self.layout.operator(
        MEANDER_OT_draw_camera.bl_idname, text="Meander Drawing from Camera (.svg)"
    )


register, unregister = registration(
    MEANDER_OT_draw_camera, MEANDER_OT_ask_draw, menus={"TOPBAR_MT_file_export": _menu}
)
