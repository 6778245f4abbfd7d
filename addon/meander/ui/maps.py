# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a result as images by a UV map of its surface."""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

from ..model import image_files, maps
from ..model.files.whole import naming, whole_files
from ..run.images import Going, Images, drawn_images
from ..run.images import going as going_on
from ..run.window import Window
from ..scene.errors import DataError
from .file_names import file_named
from .on_result import OnResult, result_of
from .refusing import refusing, sentence_of
from .registered import registration
from .ticked import KEYS, Ticked

_TIPS = {
    "mask": "White line on black",
    "distance": "From the line: black on it, white a spacing away",
    "height": "Round ridges between the turns, black on the line",
    "normal": "Normals of these ridges, with Y upwards",
    "side": "White on one side of the line, black on the other",
    "along": "Black where the line begins, white where it ends",
    "color": "The colors of the look along the line",
}
_KINDS = tuple((kind.upper(), kind.capitalize(), _TIPS[kind]) for kind in maps.KINDS)
_ALL = {name for name, _label, _tip in _KINDS}
_SUFFIXES = {suffix[1:].upper(): suffix for suffix in maps.SUFFIXES}


class MEANDER_OT_maps(OnResult, Ticked, bpy.types.Operator):
    """Write the curve as images by a UV map of its surface: for other programs, and for materials
    without a curve"""

    bl_idname = "meander.maps"
    bl_label = "Write Images"
    going_on = going_on

    filepath: StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})
    filter_glob: StringProperty(default="*.png;*.exr", options={"HIDDEN", "SKIP_SAVE"})
    file_format: EnumProperty(
        name="Format",
        description="Of the files; the end of their name chooses it as well",
        items=(
            ("PNG", "PNG", "16 bits a channel"),
            ("EXR", "OpenEXR", "32-bit floats: nothing is rounded, and colors are linear"),
        ),
    )
    kinds: EnumProperty(
        name="Images",
        description="What the images show; each becomes a file",
        items=_KINDS,
        options={"ENUM_FLAG"},
        default=_ALL,
    )
    size: IntProperty(
        name="Size",
        description="Of a side, in pixels",
        default=2048,
        min=maps.SIZES[0],
        max=maps.SIZES[1],
        subtype="PIXEL",
    )
    margin: IntProperty(
        name="Margin",
        description="How far islands go on beyond their edges, in pixels, so that no seam shows",
        default=16,
        min=0,
        soft_max=64,
        subtype="PIXEL",
    )
    line_width: FloatProperty(
        name="Line Width",
        description="Of the mask's line, in spacings",
        default=0.25,
        min=0.001,
        max=1.0,
    )
    depth: FloatProperty(
        name="Depth",
        description="From the line up to the ridges, in spacings: how steep the normals are",
        default=0.25,
        min=0.0,
        soft_max=1.0,
    )
    uv_map: StringProperty(name="UV Map", description="The active one if empty")

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "file_format")
        layout.column().prop(self, "kinds")
        for name in ("size", "margin", "line_width", "depth", "uv_map"):
            layout.prop(self, name)

    _format = ""

    def check(self, _context: bpy.types.Context) -> bool:
        before = (self.filepath, self.file_format)
        if self.file_format == self._format:  # it is the name that has changed
            self._take_format_of_name()
        self._format = self.file_format
        self.filepath = str(self._with_suffix())
        return (self.filepath, self.file_format) != before

    def _take_format_of_name(self) -> None:
        suffix = Path(self.filepath).suffix.lower()
        if suffix in maps.SUFFIXES:
            self.file_format = suffix[1:].upper()

    def _with_suffix(self) -> Path:
        path, wanted = Path(self.filepath), _SUFFIXES[self.file_format]
        known = path.suffix.lower() in maps.SUFFIXES
        return path.with_suffix(wanted) if known else path.with_name(path.name + wanted)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if not self.filepath:
            self.filepath = bpy.path.clean_name(result_of(context).name)
        self.filepath = str(self._with_suffix())
        self._format = self.file_format
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        kinds = [kind for kind in maps.KINDS if kind.upper() in self.kinds]
        if not kinds:
            raise DataError("No image is chosen; choose at least one under Images")
        self.filepath = file_named(self.filepath, ".png or .exr")
        chosen = self.properties.is_property_set("file_format")
        if not chosen or self.file_format == self._format:  # it is the name that has changed
            self._take_format_of_name()
        result, path = result_of(context), self._with_suffix()
        style = maps.Style(self.size, self.margin, self.line_width, self.depth)
        work = drawn_images(result, context, path, kinds, style, self.uv_map)
        if self.options.is_invoke and not bpy.app.background:
            return self._watch(context, Going(work, Window(context, KEYS)))
        self._write(context, image_files.finished(work))
        return {"FINISHED"}

    def _tick(self, context: bpy.types.Context, going: Going) -> Images | None:
        try:
            share = next(going.images)
        except StopIteration as end:
            return end.value
        if going.window.text_due(False):
            going.window.show(context, f"Images: {share:.0%}", share)
        return None

    def _write(self, _context: bpy.types.Context, found: Images) -> None:
        images = found.files
        with whole_files(list(images)) as temporary:
            for image, (place, data) in zip(temporary, images.items(), strict=True):
                with naming(place):
                    image.write_bytes(data)
        warning = image_files.overlap_warning(found.overlap)
        if warning:
            self.report({"WARNING"}, sentence_of(warning))
        files = "1 image" if len(images) == 1 else f"{len(images)} images"
        self.report({"INFO"}, f"{found.name}: {files} in {Path(self.filepath).parent}")


register, unregister = registration(MEANDER_OT_maps)
