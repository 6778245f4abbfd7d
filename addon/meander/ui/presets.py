# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of how the line runs: those that ship with the add-on, and those that users add.

They are Blender's own presets, files of Python below `presets/meander` in the user's scripts. What
they hold is how the line runs on any mesh, in any size: not the spacing, no seed, no vertex group,
and not what a result looks like.
"""

from __future__ import annotations

import ast
import math
import re
from pathlib import Path
from typing import Any

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
from bpy.props import StringProperty

from ..run.window import redraw
from ..scene.blender_versions import add_preset_path, remove_preset_path
from ..scene.linked_settings import lent
from .on_result import OnSettings
from .registered import registration

SUBDIR = "meander"
# Its folder presets/meander has the presets of the add-on.
_HOME = Path(__file__).resolve().parents[1]
SHIPPED = _HOME / "presets" / SUBDIR

_ASSIGNMENT = re.compile(r"\s*(?:[\w.]+\.)?(?:settings|meander)\.(\w+)\s*=\s*(.+?)\s*")

SETTINGS = (
    "preset",
    "start",
    "medial_axis",
    "use_weights",
    "length_weight",
    "bending_weight",
    "length_power",
    "medial_power",
    "segment_share",
    "reach",
    "start_spacing_factor",
    "alignment_source",
    "alignment_axis",
    "alignment_space",
    "alignment_curvature",
    "alignment_weight",
    "align_across",
    "alignment_smoothing",
    "border_distance",
    "use_outline",
)


def folders() -> list[str]:
    """Where presets are: the add-on's, then the user's."""
    others = [path for path in bpy.utils.preset_paths(SUBDIR) if Path(path) != SHIPPED]
    return [str(SHIPPED), *others]


# Of every file that has been read: when it was written, and what it sets.
_read: dict[Path, tuple[int, dict[str, Any]]] = {}


def active_name(settings: bpy.types.PropertyGroup) -> str:
    """The name of the preset whose settings these are; empty where they are nobody's."""
    for folder in folders():
        for path in sorted(Path(folder).glob("*.py")):
            values = _values_of(path)
            if values and all(_same(getattr(settings, name), values[name]) for name in values):
                return bpy.path.display_name(path.stem, title_case=False)
    return ""


def _values_of(path: Path) -> dict[str, Any]:
    """What a preset sets, read without running it; nothing where it does something else too."""
    written = path.stat().st_mtime_ns
    if path not in _read or _read[path][0] != written:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
        found = (_ASSIGNMENT.fullmatch(line) for line in lines)
        values = {match[1]: _literal(match[2]) for match in found if match and match[1] in SETTINGS}
        _read[path] = (written, values)
    return _read[path][1]


def _literal(text: str) -> Any:
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return None  # which no setting is


def _same(value: Any, other: Any) -> bool:
    if isinstance(value, float) and isinstance(other, (int, float)):
        return math.isclose(value, other, rel_tol=1e-5, abs_tol=1e-9)  # single precision
    return value == other


class MEANDER_OT_use_preset(OnSettings, bpy.types.Operator):
    """Take the settings of this preset; the spacing, the seed and the look stay as they are"""

    bl_idname = "meander.use_preset"
    bl_label = "Use Preset"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    filepath: StringProperty(name="File", subtype="FILE_PATH", options={"SKIP_SAVE"})

    def execute(self, context: bpy.types.Context) -> set[str]:
        path = Path(self.filepath)
        if not path.is_file():
            self.report({"ERROR"}, f"There is no preset at {path}; choose another")
            return {"CANCELLED"}
        # Blender's own operator for it, which keeps no undo step.
        with lent(context.active_object, SETTINGS):
            done = bpy.ops.script.execute_preset(
                filepath=str(path), menu_idname=MEANDER_PT_presets.__name__
            )
        redraw("UI")  # for the name in the panel's head
        return done


class MEANDER_OT_add_preset(OnSettings, AddPresetBase, bpy.types.Operator):
    """Keep how the line runs as a preset under a name, or remove one"""

    bl_idname = "meander.add_preset"
    bl_label = "Add Preset"
    preset_menu = "MEANDER_PT_presets"
    preset_subdir = SUBDIR
    # Without preset_defines, which do nothing in a Blender before 5.1 on Python 3.13 (Debian 13's).
    preset_values = tuple(f"bpy.context.active_object.meander.{name}" for name in SETTINGS)

    def execute(self, context: bpy.types.Context) -> set[str]:
        if self.remove_name or self.remove_active:
            file = f"{self.as_filename(self.name)}.py"
            own = any((Path(folder) / file).is_file() for folder in folders()[1:])
            if not own and (SHIPPED / file).is_file():
                self.report({"WARNING"}, "The presets of the add-on cannot be removed")
                return {"CANCELLED"}
        elif (SHIPPED / f"{self.as_filename(self.name.strip())}.py").is_file():
            self.report({"WARNING"}, "A preset of the add-on has this name; choose another")
            return {"CANCELLED"}
        with lent(context.active_object, SETTINGS):
            return super().execute(context)


class MEANDER_PT_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Presets"
    preset_subdir = SUBDIR
    preset_operator = MEANDER_OT_use_preset.bl_idname
    preset_add_operator = MEANDER_OT_add_preset.bl_idname

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.emboss = "PULLDOWN_MENU"
        layout.operator_context = "EXEC_DEFAULT"
        # Only those of the user can be removed. Blender names what is missing where it gets no
        # folder, so without one it lists nothing of the add-on's.
        own = folders()[1:]
        for paths, listed, add in (
            ([str(SHIPPED)], True, None),
            (own or [str(SHIPPED)], bool(own), self.preset_add_operator),
        ):
            self.path_menu(
                paths,
                self.preset_operator,
                filter_ext=lambda ext, listed=listed: listed and ext == ".py",
                add_operator=add,
            )


_register, _unregister = registration(
    MEANDER_OT_use_preset, MEANDER_OT_add_preset, MEANDER_PT_presets
)


def register() -> None:
    # Blender 4.3 and later then know them as an extension's; before, folders() does.
    add_preset_path(_HOME)
    _register()


def unregister() -> None:
    _unregister()
    remove_preset_path(_HOME)
