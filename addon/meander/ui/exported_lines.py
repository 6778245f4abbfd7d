# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines that an export writes, by what was chosen: of which results, and how laid out."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from bpy.props import BoolProperty

from .. import core
from ..model import before_writing, export, sheets
from ..model.files.whole import FileError
from ..model.options.export import ROWS
from ..model.toolpaths import toolpath
from ..model.toolpaths.drawing import Drawing, axes_of, seen_along
from ..model.toolpaths.sheets import Paper, number_of
from ..scene.errors import DataError
from ..scene.layouts import axes_of_view, has_map, unrolled_strands
from ..scene.meshes import triangles_of
from ..scene.points import strands_of_result
from ..scene.visible import visible_strands
from .declared import declared
from .on_result import result_of
from .preferences import page_size

# Settings that mean nothing for other tools.
_OF_TOOLS = {
    "lift": ("PEN", "SPINDLE"),
    "power": ("LASER", "SPINDLE"),
    "servo_down": ("SERVO",),
    "servo_up": ("SERVO",),
}
# Those of a brush that is dipped.
_OF_BRUSH = ("dip_x", "dip_y", "dip_height")

BY_NAME = {kind.name: kind for kind in export.FORMATS}


class ExportOptions:
    """The options of a drawing, which the table declares."""

    __annotations__ = declared(ROWS)

    def option_values(self) -> dict[str, Any]:
        """What is chosen, by setting."""
        values = {row.setting: getattr(self, row.setting) for row in ROWS}
        # What the user has typed, and not the float32 that Blender keeps of it.
        return {
            row.setting: float(f"{values[row.setting]:.6g}")
            if row.kind is float
            else values[row.setting].lower()
            if row.kind is str
            else values[row.setting]
            for row in ROWS
        }


class ExportedLines(ExportOptions):
    """What an operator with these options, and with the properties of the dialog, writes."""

    in_sheets: BoolProperty(
        name="Sheets of Paper",
        description="Write the drawing also in sheets as large as the page in the preferences of "
        "the add-on, with marks where they meet: NAME_r1c1 and so on, by row and column",
        default=False,
    )

    _view = None  # from which the dialog was opened

    def matters(self, setting: str, kind: export.Format) -> bool:
        """Whether a setting of a format means something beside the others."""
        if setting == "visible_only" and not export.is_seen(kind, self.layout_as.lower()):
            return False
        if setting in _OF_BRUSH and not self.dip_every:
            return False
        return self.tool in _OF_TOOLS.get(setting, (self.tool,))

    def lines_in(self, name: str) -> list[str] | None:
        """The lines of a file of G-code that was chosen; None: none was."""
        return export.lines_of(Path(bpy.path.abspath(name))) if name else None

    def _paper(self, kind: export.Format) -> Paper | None:
        """The sheets that are wanted."""
        wanted = self.in_sheets and export.takes_sheets(kind, self.option_values())
        return Paper(*page_size(), turns=True) if wanted else None

    def number_of_sheets(self, kind: export.Format, drawing: Drawing) -> str:
        """How many sheets a drawing takes, behind its size. Raises FileError for too many."""
        paper = self._paper(kind)
        if paper is None:
            return ""
        number = number_of(drawing, paper)
        return f", {number} sheet{'s' * (number != 1)}"

    def written_sheets(
        self,
        path: Path,
        kind: export.Format,
        drawing: Drawing,
        head: Sequence[str] | None,
        foot: Sequence[str] | None,
    ) -> str:
        """Writes the sheets of a drawing where they are wanted, and says so."""
        paper, values = self._paper(kind), self.option_values()
        if paper is None:
            return ""
        done = sheets.write(path, kind, drawing, values, paper, core.VERSION, head, foot)
        return f"; {sheets.described(path, done)}"

    def _chosen(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        return results_of(context) if self.selected else [result_of(context)]

    def _strands(
        self, result: bpy.types.Object, depsgraph: bpy.types.Depsgraph
    ) -> list[toolpath.Strand]:
        """What is written of a result: the line that is seen, or the curve."""
        return strands_of_result(result, depsgraph, as_drawn=self.round_turns)

    def _laid_out(
        self, kind: export.Format, values: dict[str, Any], context: bpy.types.Context
    ) -> list[toolpath.Strand]:
        layout = values["layout_as"] if "layout_as" in kind.options else "space"
        depsgraph = context.evaluated_depsgraph_get()
        results = self._chosen(context)
        strands = [strand for each in results for strand in self._strands(each, depsgraph)]
        surfaces = list(dict.fromkeys(result.meander.surface for result in results))
        if layout == "uv":
            if len(surfaces) > 1:
                raise DataError("Unrolled takes curves on one surface; select no others")
            return unrolled_strands(strands, surfaces[0], depsgraph, self.uv_map)
        if not export.is_seen(kind, layout):
            return strands
        if layout == "view":
            axes = axes_of_view(self._view or view_of(context))
        else:
            axes = axes_of(layout)
        if values["visible_only"]:
            meshes = [triangles_of(surface, depsgraph) for surface in surfaces]
            strands = visible_strands(strands, *axes, *_joined(meshes))
        return seen_along(strands, *axes)

    def _layout_by_shape(self, context: bpy.types.Context) -> str:
        """In space where the format can have it."""
        kind = BY_NAME.get(self.file_format)
        if kind is None or not kind.flat:
            return "SPACE"
        result, depsgraph = result_of(context), context.evaluated_depsgraph_get()
        surface = result.meander.surface
        try:
            triangles = triangles_of(surface, depsgraph)
            strands = self._strands(result, depsgraph)
            several = self.selected and len(results_of(context)) > 1
            found = not (self.visible_only or several) and has_map(surface, depsgraph)
        except DataError:  # which writing reports
            return "SPACE"
        return before_writing.layout_by_shape(*triangles, strands, found).upper()

    def _sides(self, context: bpy.types.Context) -> np.ndarray | None:
        """Width and height of a flat drawing; None where there is none, or no page for it."""
        kind = BY_NAME.get(self.file_format)
        if kind is None or "size" not in kind.options:
            return None
        try:
            strands = self._laid_out(kind, self.option_values(), context)
        except (DataError, core.MeanderError, FileError):  # which writing reports
            return None
        return np.ptp(np.concatenate([strand.points for strand in strands]), axis=0)[:2]

    def _resampled(
        self, strands: Sequence[toolpath.Strand], mesh: toolpath.Mesh | None
    ) -> list[toolpath.Strand]:
        return toolpath.resampled(
            strands,
            self.step if self.resample == "STEP" else None,
            self.tolerance if self.resample == "TOLERANCE" else None,
            mesh,
        )


def results_of(context: bpy.types.Context) -> list[bpy.types.Object]:
    """The active curve, and the others that are selected and made by Meander."""
    active = result_of(context)
    others = (
        thing
        for thing in context.selected_objects
        if thing != active and thing.type == "CURVE" and thing.meander.surface is not None
    )
    return [active, *sorted(others, key=lambda thing: thing.name)]


def _joined(meshes: Sequence[tuple[np.ndarray, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of several meshes as those of one."""
    firsts = np.cumsum([0] + [len(vertices) for vertices, _faces in meshes])
    return (
        np.vstack([vertices for vertices, _faces in meshes]),
        np.vstack([faces + first for (_vertices, faces), first in zip(meshes, firsts)]),
    )


def view_of(context: bpy.types.Context) -> bpy.types.RegionView3D | None:
    """The 3D view in which the mouse is, or else the largest one of the window."""
    if context.area is not None and context.area.type == "VIEW_3D":
        return context.space_data.region_3d
    areas = context.screen.areas if context.screen is not None else ()
    areas = [area for area in areas if area.type == "VIEW_3D"]
    if not areas:
        return None
    return max(areas, key=lambda area: area.width * area.height).spaces.active.region_3d
