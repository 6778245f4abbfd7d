# SPDX-License-Identifier: GPL-3.0-or-later
"""The dialog of an export: what it begins with, what it says, and what a refusal leaves."""

from __future__ import annotations

from types import FunctionType, SimpleNamespace

import bpy
import numpy as np
import pytest
from meander.model import before_writing as model
from meander.ui import export
from panel_layout import Layout
from scenes import activate, fill, sphere

OPERATOR = export.MEANDER_OT_export_toolpath


@pytest.fixture
def result() -> bpy.types.Object:
    bpy.ops.mesh.primitive_torus_add(major_segments=24, minor_segments=12)
    torus = bpy.context.active_object
    found = fill(torus, 0.3)
    yield activate(found)
    export._refused.end()


def dialog(**given):
    """An operator as the file browser has it; in background none can be opened."""
    functions = {
        name: value
        for kind in (export.ExportOptions, export.ExportedLines, OPERATOR)
        for name, value in vars(kind).items()
        if isinstance(value, FunctionType)
    }
    known = bpy.ops.meander.export_toolpath.get_rna_type().properties
    values = {each.identifier: each.default for each in known if hasattr(each, "default")}
    of_class = {name: getattr(OPERATOR, name) for name in ("_view", "_format", "_by_shape",
                "_size", "_by_page", "_is_refused", "bl_idname")}  # fmt: skip
    chosen: set[str] = set()

    def choose(self, name: str, value: object) -> None:
        chosen.add(name)
        object.__setattr__(self, name, value)

    rna = {"bl_rna": bpy.ops.meander.export_toolpath.get_rna_type(), "__setattr__": choose}
    operator = type("Dialog", (), functions | of_class | values | rna)()
    operator.properties = SimpleNamespace(is_property_set=lambda name: name in chosen)
    for name, value in given.items():
        setattr(operator, name, value)
    operator.invoke(_Context(), None)
    return operator


class _Context:
    """The context, with a window manager that opens no file browser."""

    window_manager = SimpleNamespace(fileselect_add=lambda _operator: None)

    def __getattr__(self, name):
        return getattr(bpy.context, name)


def test_what_is_unrolled_begins_as_large_as_a_page(result):
    opened = dialog(file_format="SVG")
    assert opened.layout_as == "UV"
    # A map of a torus is a square; A4 has 180 mm beside its margins.
    assert opened.size == pytest.approx(180.0, abs=0.5)
    assert not opened._is_refused and "180" in opened._size
    opened.layout_as = "TOP"
    opened.check(bpy.context)
    assert opened.size == 0.0, "what is seen keeps its true size"
    opened.layout_as = "UV"
    opened.check(bpy.context)
    assert opened.size == pytest.approx(180.0, abs=0.5)
    opened.size = 90.0
    opened.check(bpy.context)
    assert opened.size == 90.0, "a size that was chosen stays"
    assert dialog(file_format="SVG", size=50.0).size == 50.0


def test_a_drawing_comes_in_sheets_of_the_page(result, tmp_path) -> None:
    opened = dialog(file_format="SVG", size=400.0)
    assert "sheet" not in opened._size
    opened.in_sheets = True
    opened.check(bpy.context)
    assert opened._size.endswith(", 6 sheets")
    panel = Layout()
    opened.layout = panel
    opened.draw(bpy.context)
    assert "Sheets of Paper" in [each.text for each in panel.texts()]
    opened.in_sheets, opened.size = True, 1e4
    opened.check(bpy.context)
    assert opened._is_refused and "more than 1,000" in opened._size
    path = tmp_path / "line.svg"
    export_curve = bpy.ops.meander.export_toolpath
    assert export_curve(filepath=str(path), layout_as="UV", size=400, in_sheets=True) == {
        "FINISHED"
    }
    names = {f"line_r{row}c{column}.svg" for row in (1, 2) for column in (1, 2, 3)}
    assert {each.name for each in tmp_path.iterdir()} == names | {"line.svg"}
    pages = [(tmp_path / name).read_text() for name in names]
    assert all('width="210mm" height="297mm"' in text for text in pages)
    # A drawing in space has no sheets, and those of one that is refused are not written.
    opened = dialog(file_format="DXF", layout_as="SPACE", in_sheets=True)
    assert "sheet" not in opened._size
    with pytest.raises(RuntimeError, match="more than 1,000"):
        export_curve(filepath=str(tmp_path / "a.svg"), layout_as="UV", size=9999, in_sheets=True)
    assert not list(tmp_path.glob("a*"))


@pytest.mark.parametrize(
    "sides, longest", [((1, 1), 180.0), ((3, 1), 267.0), ((1, 3), 267.0), ((1.2, 1), 216.0)]
)
def test_a_drawing_fills_a_page_that_lies_or_stands(sides, longest):
    size = model.size_on_page(sides, (210.0, 297.0), 15.0)
    assert size == pytest.approx(longest)
    short, long = np.sort(sides) * size / max(sides)
    assert short <= 180.0 + 1e-9 and long <= 267.0 + 1e-9


def test_the_size_is_red_where_no_machine_could_draw_it(result):
    opened = dialog(file_format="SVG", layout_as="TOP", scale=1e5, size=0.0)
    assert opened._is_refused and "no machine" in opened._size
    opened.layout = Layout()
    opened.draw(bpy.context)
    opened.force = True
    opened.check(bpy.context)
    assert not opened._is_refused


def test_a_refused_dialog_comes_back_as_it_was(result, tmp_path):
    path = str(tmp_path / "huge.gcode")
    with pytest.raises(RuntimeError, match="no machine"):
        bpy.ops.meander.export_toolpath(
            filepath=path, file_format="GCODE", layout_as="TOP", scale=1e5, tool="LASER"
        )
    again = dialog()
    assert (again.file_format, again.layout_as, again.tool) == ("GCODE", "TOP", "LASER")
    assert again.scale == pytest.approx(1e5) and again.filepath == path
    assert again._is_refused
    again.check(bpy.context)
    assert again.layout_as == "TOP", "what was chosen stays chosen"
    assert dialog(file_format="DXF").file_format == "DXF", "what it is told comes first"
    bpy.ops.meander.export_toolpath(filepath=path, file_format="GCODE", layout_as="TOP")
    assert dialog().file_format != "GCODE", "what was written is Blender's to remember"


def test_a_refusal_is_of_its_own_curve(result, tmp_path):
    other = fill(sphere(), 0.3)
    activate(result)
    with pytest.raises(RuntimeError, match="no machine"):
        bpy.ops.meander.export_toolpath(
            filepath=str(tmp_path / "a.dxf"), file_format="DXF", layout_as="TOP", scale=1e5
        )
    activate(other)
    assert dialog().file_format == "SVG"


def test_a_layout_that_was_chosen_stays(result):
    opened = dialog(file_format="SVG", layout_as="FRONT")
    opened.check(bpy.context)
    assert opened.layout_as == "FRONT"
