# SPDX-License-Identifier: GPL-3.0-or-later
"""The export of a result to files for machines: the dialog, and the entry in File > Export."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from .. import core
from ..model import before_writing, export
from ..model.files.whole import FileError
from ..model.geometry import surface_crossings
from ..model.toolpaths import embroidery, ros, toolpath, usd
from ..model.toolpaths.drawing import Drawing
from ..model.toolpaths.sheets import MARGIN
from ..run import rounding
from ..run.lasting import Activity
from ..scene import drawn_line
from ..scene.bake import frames_of
from ..scene.errors import DataError
from ..scene.identity import Key
from ..scene.layouts import metres_of
from ..scene.meshes import triangles_of
from .exported_lines import BY_NAME, ExportedLines, ExportOptions, results_of, view_of
from .file_names import file_named
from .on_result import OnResult, result_of
from .preferences import page_size
from .refusing import refusing, sentence_of
from .registered import registration

_TABLES = {suffix[1:].upper(): suffix for suffix in toolpath.SUFFIXES}
_SUFFIXES = _TABLES | {kind.name: kind.suffixes[0] for kind in export.FORMATS}


class _Refused(NamedTuple):
    """What was chosen in a dialog whose drawing was refused, for the next one on that curve."""

    result: Key
    values: dict[str, Any]


_refused: Activity[_Refused] = Activity()


class MEANDER_OT_export_toolpath(OnResult, ExportedLines, bpy.types.Operator):
    """Write the curve to a file for plotters, lasers, mills, printers or embroidery"""

    bl_idname = "meander.export_toolpath"
    bl_label = "Export Curve"

    filepath: StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})
    filter_glob: StringProperty(
        default=";".join(f"*{suffix}" for suffix in (*_TABLES.values(), *export.SUFFIXES)),
        options={"HIDDEN", "SKIP_SAVE"},
    )
    file_format: EnumProperty(
        name="Format",
        description="Format of the file",
        items=(
            *((kind.name, kind.label, kind.tip) for kind in export.FORMATS),
            ("CSV", "CSV", "A row for every point, with normals and triangles"),
            ("JSON", "JSON", "A list of strands, with normals and triangles"),
            ("NPZ", "NumPy", "Arrays of all points, with normals and triangles, for large curves"),
        ),
    )
    resample: EnumProperty(
        name="Points",
        description="Which points are written",
        items=(
            ("ALL", "All", "Every point of the curve"),
            ("STEP", "By Step", "At equal arc lengths along each strand"),
            ("TOLERANCE", "By Tolerance", "As few as keep the chords between them near the curve"),
        ),
    )
    step: FloatProperty(
        name="Step",
        description="Largest arc length between two points",
        unit="LENGTH",
        default=0.01,
        min=1e-6,
    )
    tolerance: FloatProperty(
        name="Tolerance",
        description="Largest distance of the chord between two points from the curve",
        unit="LENGTH",
        default=0.001,
        min=1e-9,
        precision=4,
    )
    animated: BoolProperty(
        name="Baked Frames",
        description="Write the frames that were baked from the curve, if there are any, as samples "
        "in time",
        default=True,
    )
    selected: BoolProperty(
        name="All Selected",
        description="Draw all selected curves that Meander has made, not only the active one",
        default=False,
    )
    round_turns: BoolProperty(
        name="Round Turns",
        description="Write the line as the look draws it, with round turns; off: the curve itself",
        default=True,
    )
    header: StringProperty(
        name="Header",
        description="File of lines of G-code behind the unit, in place of those of the machine",
        subtype="FILE_PATH",
    )
    footer: StringProperty(
        name="Footer",
        description="File of lines of G-code at the end, in place of those of the machine",
        subtype="FILE_PATH",
    )
    frame_id: StringProperty(
        name="Frame", description="Frame of reference that messages of ROS name", default=ros.FRAME
    )
    uv_map: StringProperty(
        name="UV Map", description="UV map that lays the curve flat; the active one if empty"
    )

    _format = _by_shape = _size = ""
    _by_page = 0.0  # the size that was chosen for a page
    _is_refused = False  # whether writing would say no

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "file_format")
        kind = BY_NAME.get(self.file_format)
        if kind is not None and len(results_of(context)) > 1:
            layout.prop(self, "selected")
        for setting in () if kind is None else kind.options:
            if not self.matters(setting, kind):
                continue
            row = layout.row()
            row.active = setting != "scale" or self.size == 0.0
            row.prop(self, setting)
            if setting == "layout_as" and self.layout_as == "UV":
                result = result_of(context)
                surface = result.meander.surface
                if surface.type == "MESH":
                    layout.prop_search(self, "uv_map", surface.data, "uv_layers")
        if export.takes_sheets(kind, self.option_values()):
            layout.prop(self, "in_sheets")
        row = layout.row()
        row.active = any(drawn_line.tolerance_of(each) for each in self._chosen(context))
        row.prop(self, "round_turns")
        if self._size:
            row = layout.row()
            row.alert = self._is_refused
            row.label(text=self._size, icon="ERROR" if self._is_refused else "FIXED_SIZE")
        if kind is not None and kind.name == "GCODE":
            layout.prop(self, "header")
            layout.prop(self, "footer")
        if kind is not None and kind.name in ("DST", "PES"):
            if not embroidery.is_there():
                layout.label(text=f"{embroidery.PACKAGE} is not installed", icon="ERROR")
        if kind is not None and kind.name == "ROS":
            layout.prop(self, "frame_id")
        if export.takes_frames(kind):
            layout.prop(self, "animated")
        if kind is not None and not export.has_own_points(kind):
            return
        layout.prop(self, "resample")
        if self.resample == "STEP":
            layout.prop(self, "step")
        elif self.resample == "TOLERANCE":
            layout.prop(self, "tolerance")

    def check(self, context: bpy.types.Context) -> bool:
        before = (self.filepath, self.file_format)
        if self.file_format == self._format:  # it is the name that has changed
            self._take_format_of_name()
        self._format = self.file_format
        self.filepath = str(self._with_suffix())
        if self.layout_as == self._by_shape:  # nobody has chosen another
            self._by_shape = self.layout_as = self._layout_by_shape(context)
        self._look_at_size(context)
        return (self.filepath, self.file_format) != before

    def _with_suffix(self) -> Path:
        path = Path(self.filepath)
        suffix, wanted = export.suffix_of(path), _SUFFIXES[self.file_format]
        kind = BY_NAME.get(self.file_format)
        if suffix == wanted or kind is not None and suffix in kind.suffixes:
            return path
        known = suffix in (*_TABLES.values(), *export.SUFFIXES)
        stem = path.name[: -len(suffix)] if known else path.name
        return path.with_name(stem + wanted)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        take_up_refused(self, result_of(context))
        if not self.filepath:
            self.filepath = bpy.path.clean_name(result_of(context).name)
        self.filepath = str(self._with_suffix())
        # In the dialog there is no 3D view to ask.
        self._view, self._format = view_of(context), self.file_format
        if not self.properties.is_property_set("layout_as"):
            self._by_shape = self.layout_as = self._layout_by_shape(context)
        self._look_at_size(context)
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        result = Key(result_of(context))
        try:
            done = self._write(context)
        except (DataError, core.MeanderError, FileError):
            # Blender remembers what was chosen of what has been done only.
            kept = {name: getattr(self, name) for name in _KEPT}
            _refused.begin(_Refused(result, kept))
            raise
        _refused.end()
        return done

    def _write(self, context: bpy.types.Context) -> set[str]:
        if self.round_turns:
            rounding.on_output()
        self.filepath = file_named(self.filepath, "a suffix such as .svg")
        if not self.properties.is_property_set("file_format"):
            self._take_format_of_name()
        if not self.properties.is_property_set("layout_as"):
            self.layout_as = self._layout_by_shape(context)
        given, path, kind = Path(self.filepath), self._with_suffix(), BY_NAME.get(self.file_format)
        if kind is None:
            text, warning = self._write_table(path, context)
        else:
            drawing, of_sheets = self._write_drawing(path, kind, context)
            text = drawing.described() + of_sheets
            warning = before_writing.crossing_warning(drawing, kind, self.option_values())
        becomes = f"{given.name} becomes " if given.suffix not in ("", path.suffix) else ""
        self.report({"INFO"}, f"{becomes}{path.name}: {text}")
        if warning:
            self.report({"WARNING"}, sentence_of(warning))
        return {"FINISHED"}

    def _look_at_size(self, context: bpy.types.Context) -> None:
        """Says how large the drawing will be, or why there is none; what is unrolled begins as
        large as the page of the preferences."""
        kind = BY_NAME.get(self.file_format)
        of_machine = kind is not None and "force" in kind.options
        on_page = of_machine and self.layout_as == "UV" and self.scale == 1.0
        if self.size == self._by_page:  # nobody has chosen another
            self.size = 0.0
            sides = self._sides(context) if on_page else None
            if sides is not None:
                self.size = round(before_writing.size_on_page(sides, page_size(), MARGIN), 1)
                if self.unit == "in":
                    self.size = round(self.size / 25.4, 3)
            self._by_page = self.size
        self._is_refused = False
        self._size = self._size_text(context)

    def _size_text(self, context: bpy.types.Context) -> str:
        """How large the drawing will be, or why there is none; for the dialog."""
        kind = BY_NAME.get(self.file_format)
        if kind is None:
            return ""
        values = self.option_values() | {"visible_only": False, "arc_tolerance": 0.0}
        try:
            laid = self._laid_out(kind, values, context)
            drawing = export.sized(laid, kind, values, metres_of(context.scene))
            size = drawing.size_text() + self.number_of_sheets(kind, drawing)
        except (DataError, core.MeanderError, FileError) as error:
            self._is_refused = True
            return sentence_of(error)
        problem = before_writing.unusable(drawing, kind, values)
        self._is_refused = problem is not None
        return size if problem is None else sentence_of(problem.what)

    def _take_format_of_name(self) -> None:
        """A known suffix says what the format is."""
        path = Path(self.filepath)
        kind = export.format_of(path)
        table = export.suffix_of(path)[1:].upper()
        if kind is not None:
            self.file_format = kind.name
        elif table in _TABLES:
            self.file_format = table

    def _write_table(self, path: Path, context: bpy.types.Context) -> tuple[str, str]:
        """What to say of it, and what to warn of; empty if nothing."""
        result, depsgraph = result_of(context), context.evaluated_depsgraph_get()
        strands = self._strands(result, depsgraph)
        mesh = toolpath.Mesh(*triangles_of(result.meander.surface, depsgraph))
        strands = self._resampled(strands, mesh)
        toolpath.write(path, strands, core.VERSION)
        count = sum(len(strand.points) for strand in strands)
        places = surface_crossings.crossings(
            [strand.points for strand in strands],
            [strand.normals for strand in strands],
            [strand.closed for strand in strands],
            result.meander.figures.least_spacing or result.meander.spacing,
        )
        warning = surface_crossings.crossing_warning(places)
        of_strands = "1 strand" if len(strands) == 1 else f"{len(strands):,} strands"
        return f"{count:,} points in {of_strands}", warning

    def _write_drawing(
        self, path: Path, kind: export.Format, context: bpy.types.Context
    ) -> tuple[Drawing, str]:
        """What it has written, and what to say of sheets."""
        values, title = self.option_values(), result_of(context).name
        if export.lacks_plane(kind, values):
            raise FileError("Arcs lie in a plane; choose a Layout that is flat")
        if path.suffix.lower() in (".usdc", ".usd") and not usd.is_there():
            raise FileError(usd.missing_text())
        if kind.name in ("DST", "PES") and not embroidery.is_there():
            modules = bpy.utils.user_resource("SCRIPTS", path="addons/modules")
            raise FileError(embroidery.missing_text(modules))
        strands = self._laid_out(kind, values, context)
        result = result_of(context)
        if export.has_own_points(kind):
            strands = self._resampled(strands, None)
        spacing = result.meander.figures.least_spacing
        if "thickness" in kind.options:
            spacing = spacing or result.meander.spacing
        frames: list[tuple[float, list[toolpath.Strand]]] = []
        if export.takes_frames(kind) and self.animated and not export.is_flat(kind, values):
            frames = [
                (frame, self._resampled(moved, None))
                for frame, moved in frames_of(
                    result, context, context.scene.frame_start, context.scene.frame_end
                )
            ]
        render = context.scene.render
        drawing = export.prepared(
            strands, kind, values, metres_of(context.scene), spacing,
            frames=frames, rate=render.fps / render.fps_base,
        )  # fmt: skip
        problem = before_writing.unusable(drawing, kind, values)
        if problem is not None:
            way = "choose another Layout" if problem.edge else "choose a Size or Scale"
            raise FileError(f"The drawing {problem.what}; {way}, or Write Anyway")
        ends = (self.lines_in(self.header), self.lines_in(self.footer))
        of_sheets = self.written_sheets(path, kind, drawing, *ends)
        export.write(path, kind, drawing, values, title, core.VERSION, *ends, self.frame_id)
        return drawing, of_sheets


# What a refused dialog hands on; where it was and which files are listed, Blender knows.
_KEPT = frozenset(
    {"filepath", "file_format", "resample", "step", "tolerance", "selected", "header", "footer"}
    | {"in_sheets"}
    | {"uv_map", "frame_id", "animated", "round_turns"}
    | set(ExportOptions.__annotations__)
)


def take_up_refused(operator: Any, result: bpy.types.Object) -> None:
    """Gives a dialog what the last one on a curve had, where that was refused; nothing that it
    was told itself."""
    refused = _refused.current
    if refused is None or refused.result.find() != result:
        return
    for name, value in refused.values.items():
        if not operator.properties.is_property_set(name):
            setattr(operator, name, value)


def _menu(self: bpy.types.Menu, _context: bpy.types.Context) -> None:
    self.layout.operator(
        MEANDER_OT_export_toolpath.bl_idname,
        text="Meander Curve (.svg, .dxf, .gcode, .dst, .usd, .glb, .csv, ...)",
    )


register, unregister = registration(
    MEANDER_OT_export_toolpath, menus={"TOPBAR_MT_file_export": _menu}
)
