# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a sheet of a picture in a file, with settings that draw it in one line, and fills it."""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from ..model.picture.line import Wishes, plans_of
from ..model.picture.tone import Tone
from ..run.lasting import why_busy
from ..scene.errors import DataError
from ..scene.layouts import metres_of
from ..scene.picture import new_sheet, read_picture
from .reasons import Reasoned, Reasons, not_in_object_mode
from .refusing import refusing
from .registered import registration

_MILLIMETRE = 0.001


class MEANDER_OT_picture(Reasoned, bpy.types.Operator):
    """Make a sheet of a picture, and draw it on the sheet in one line that never crosses itself:
    strands are closer where the picture is darker"""

    bl_idname = "meander.picture"
    bl_label = "Picture in One Line"
    bl_options = {"UNDO"}

    filepath: StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})
    filter_image: BoolProperty(default=True, options={"HIDDEN", "SKIP_SAVE"})
    filter_folder: BoolProperty(default=True, options={"HIDDEN", "SKIP_SAVE"})
    width: FloatProperty(
        name="Width (mm)",
        description="Of the drawing, in millimetres; its height follows from the picture",
        default=Wishes.width,
        min=1.0,
        max=1e5,
    )
    pen: FloatProperty(
        name="Pen (mm)",
        description="Width of the line, in millimetres; a finer one shows finer details, and takes "
        "longer",
        default=0.8,
        min=0.001,
        soft_min=0.1,
        soft_max=5.0,
    )
    style: EnumProperty(
        name="Style",
        description="How the line lies",
        items=(
            ("PORTRAIT", "Portrait", "Long level rows, whose tones are the best"),
            ("ENGRAVING", "Engraving", "Rows along the edges and forms of the picture"),
            ("SCRIBBLE", "Scribble", "Grown from a small loop"),
        ),
    )
    tone: EnumProperty(
        name="Tone",
        description="How dark the drawing is where",
        items=(
            ("EYE", "Eye", "The picture's lightness, fitted into what the pen can have"),
            ("LIGHT", "Light", "As much light as the picture reflects; clipped where a pen cannot"),
            ("VALUE", "Value", "By the numbers of the file; clipped where a pen cannot"),
        ),
    )
    local_contrast: FloatProperty(
        name="Local Contrast",
        description="How much more each part differs from what is around it",
        default=0.0,
        min=0.0,
        max=5.0,
        soft_max=1.0,
    )
    leave_white: FloatProperty(
        name="Leave White",
        description="No line where the drawing would be less dark; at 0 there is a line everywhere",
        default=0.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    fill: BoolProperty(
        name="Fill",
        description="Draw the line at once. Off: only the sheet is made, to be changed first",
        default=True,
    )

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        yield why_busy()
        yield not_in_object_mode(context)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in ("width", "pen", "style", "tone", "local_contrast", "leave_white", "fill"):
            layout.prop(self, name)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        path = Path(bpy.path.abspath(self.filepath))
        if not path.is_file():
            raise DataError("No picture is chosen; choose a file with one")
        wishes = Wishes(
            self.width,
            self.pen,
            style=self.style.lower(),
            tone=Tone(self.tone.lower(), local_contrast=self.local_contrast),
            leave_white=self.leave_white,
        )
        (plan,) = plans_of(read_picture(path), wishes)
        scene = context.scene
        sheet = new_sheet(path.stem, plan, wishes, scene, _MILLIMETRE / metres_of(scene))
        for other in context.selected_objects:
            other.select_set(False)
        sheet.select_set(True)
        context.view_layer.objects.active = sheet
        if self.fill:
            how = "EXEC_DEFAULT" if bpy.app.background else "INVOKE_DEFAULT"
            bpy.ops.meander.run(how)
        return {"FINISHED"}


register, unregister = registration(MEANDER_OT_picture)
