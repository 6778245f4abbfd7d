# SPDX-License-Identifier: GPL-3.0-or-later
"""Files for machines, read back by other means than they were written: lengths, order, units."""

from __future__ import annotations

import locale
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field

import numpy as np
import pytest
from meander.model import export
from meander.model.files.whole import FileError
from meander.model.toolpaths import toolpath
from meander.model.toolpaths.drawing import VIEWS, drawing_of, seen_along
from meander.model.toolpaths.gcode import Motion, gcode_pieces

MM_OF = {"mm": 1.0, "cm": 10.0, "in": 25.4}


def strands(scale: float = 1.0, offset: float = 3.0) -> list[toolpath.Strand]:
    """A closed strand that winds around a cylinder and an open one, in scene units."""
    angle = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False)
    ring = np.column_stack([np.cos(angle), np.sin(angle), 0.3 * np.sin(5.0 * angle)])
    rise = np.linspace(0.0, 4.0, 80)
    helix = np.column_stack([np.cos(rise), np.sin(rise), 1.0 + 0.2 * rise])
    return [
        toolpath.strand_of(
            (points + offset) * scale, points * [1.0, 1.0, 0.0] / np.hypot(*points.T[:2])[:, None],
            closed,
        )
        for points, closed in ((ring, True), (helix, False))
    ]


def length_of(points: np.ndarray, closed: bool) -> float:
    around = np.vstack([points, points[:1]]) if closed else points
    return float(np.linalg.norm(np.diff(around, axis=0), axis=1).sum())


def written(path, values=None, laid=None, metres=1.0):
    kind = export.format_of(path)
    values = {**export.DEFAULTS, **(values or {})}
    drawing = export.prepared(laid or strands(), kind, values, metres)
    export.write(path, kind, drawing, values, "A <curve> & more", "1.2.3")
    return path.read_bytes()


def flat(view: str = "top") -> list[toolpath.Strand]:
    return seen_along(strands(), *VIEWS[view])


@pytest.mark.parametrize("unit", ["mm", "cm", "in"])
@pytest.mark.parametrize("view", ["top", "front", "side"])
def test_svg_is_the_view_in_real_units(tmp_path, unit, view):
    values = {"unit": unit, "layout_as": view, "scale": 0.05, "line_width": 0.4}
    root = ElementTree.fromstring(written(tmp_path / "a.svg", values, flat(view)))
    space = "{http://www.w3.org/2000/svg}"
    assert root.find(f"{space}title").text == "A <curve> & more"
    number, found = re.fullmatch(r"([\d.]+)(\w+)", root.get("width")).groups()
    assert found == unit
    box = [float(value) for value in root.get("viewBox").split()]
    assert box[:2] == [0.0, 0.0] and box[2] == float(number)
    assert float(re.match(r"[\d.]+", root.get("height"))[0]) == box[3]
    group = root.find(f"{space}g")
    assert float(group.get("stroke-width")) * MM_OF[unit] == pytest.approx(0.4, abs=1e-3)
    paths = group.findall(f"{space}path")
    assert len(paths) == 2
    axes = {"top": (0, 1), "front": (0, 2), "side": (1, 2)}[view]
    factor = 0.05 * 1000.0 / MM_OF[unit]
    for path, strand in zip(paths, strands()):
        text = path.get("d")
        assert text.endswith("Z") == strand.closed
        places = np.array([float(value) for value in re.findall(r"-?\d+\.?\d*", text)])
        places = places.reshape(-1, 2)
        wanted = strand.points[:, axes] * factor * [1.0, -1.0]
        assert len(places) == len(wanted)
        # The same but for where the paper lies.
        assert np.allclose(places - places[0], wanted - wanted[0], atol=2e-3 / MM_OF[unit] ** 0.9)
        assert length_of(places, strand.closed) == pytest.approx(
            length_of(wanted, strand.closed), rel=1e-3
        )
        assert places.min() > 0.0 and (places < box[2:]).all()


def test_size_is_that_of_the_longest_side(tmp_path):
    root = ElementTree.fromstring(written(tmp_path / "a.svg", {"size": 120.0}, flat()))
    sides = [float(value) for value in root.get("viewBox").split()[2:]]
    assert max(sides) == pytest.approx(120.0 + 2 * 0.3)


def read_dxf(text: str):
    """Polylines of a DXF file by the reference of release 12, and its unit."""
    lines = text.split("\n")
    pairs = [(int(code), value) for code, value in zip(lines[0:-1:2], lines[1:-1:2])]
    assert pairs[-1] == (0, "EOF")
    unit = next(pairs[i + 1] for i, pair in enumerate(pairs) if pair == (9, "$INSUNITS"))
    polylines, entity, values = [], "", {}
    for code, value in [*pairs, (0, "")]:
        if code == 0:
            if entity == "POLYLINE":
                polylines.append((int(values[70]), []))
            elif entity == "VERTEX":
                polylines[-1][1].append([float(values[axis]) for axis in (10, 20, 30)])
            entity, values = value, {}
        else:
            values[code] = value
    return unit, [(flags, np.array(points)) for flags, points in polylines]


def test_dxf_holds_polylines_in_space_and_flat_ones(tmp_path):
    unit, polylines = read_dxf(written(tmp_path / "a.dxf", {"unit": "in"}).decode("ascii"))
    assert unit == (70, "1")
    for (flags, points), strand in zip(polylines, strands(), strict=True):
        assert flags == 8 + strand.closed
        assert np.allclose(points, strand.points * 1000.0 / 25.4, atol=1e-7)
    values = {"unit": "cm", "layout_as": "front"}
    unit, polylines = read_dxf(written(tmp_path / "a.dxf", values, flat("front")).decode("ascii"))
    assert unit == (70, "5")
    for (flags, points), strand in zip(polylines, flat("front"), strict=True):
        assert flags == strand.closed
        assert (points[:, 2] == 0.0).all() and points.min() >= 0.0
        assert length_of(points, strand.closed) == pytest.approx(
            100.0 * length_of(strand.points, strand.closed), rel=1e-6
        )


@dataclass
class Machine:
    """A machine that runs G-code, and notes where it cuts, travels and what it extrudes."""

    factor: float = 0.0
    place: list = field(default_factory=lambda: [0.0, 0.0, 0.0])
    cuts: list = field(default_factory=list)  # runs of places
    travels: list = field(default_factory=list)
    feeds: set = field(default_factory=set)
    extruded: float = 0.0

    def run(self, text: str) -> None:
        absolute = relative_extrusion = ended = False
        for line in text.splitlines():
            words = line.split(";")[0].split()
            if not words:
                continue
            assert not ended
            code, values = words[0], {word[0]: float(word[1:]) for word in words[1:]}
            if code in ("G20", "G21"):
                self.factor = 25.4 if code == "G20" else 1.0
            elif code == "G90":
                absolute = True
            elif code in ("M82", "M83"):
                relative_extrusion = code == "M83"
            elif code == "M2":
                ended = True
            else:
                assert code in ("G0", "G1") and absolute and self.factor
                self._move(code, values, relative_extrusion)
        assert ended

    def _move(self, code, values, relative_extrusion):
        before = list(self.place)
        for axis, name in enumerate("XYZ"):
            self.place[axis] = values.get(name, self.place[axis] / self.factor) * self.factor
        if "F" in values:
            self.feeds.add((code, round(values["F"] * self.factor, 1)))
        if "E" in values:
            assert relative_extrusion and code == "G1"
            self.extruded += values["E"] * self.factor
        if code == "G0":
            self.travels.append((before, list(self.place)))
        elif before[:2] == self.place[:2]:  # down to the beginning of a strand
            self.cuts.append([list(self.place)])
        else:
            self.cuts[-1].append(list(self.place))


@pytest.mark.parametrize("unit", ["mm", "in"])
def test_gcode_follows_every_strand_in_every_layer(tmp_path, unit):
    values = {
        "unit": unit, "scale": 0.02, "feed": 900.0, "lift": 7.0, "layer_offset": 0.5, "layers": 3,
        "layer_height": 0.25, "extrusion": 0.05,
    }
    machine = Machine()
    machine.run(written(tmp_path / "a.gcode", values).decode("ascii"))
    assert len(machine.cuts) == 6
    top = max(point[2] for cut in machine.cuts for point in cut)
    total = 0.0
    for number, cut in enumerate(machine.cuts):
        strand = strands()[number % 2]
        offset = 0.5 + 0.25 * (number // 2)
        wanted = strand.points * 20.0 + offset * strand.normals
        if strand.closed:
            wanted = np.vstack([wanted, wanted[:1]])
        assert np.allclose(cut, wanted, atol=1e-4)
        total += length_of(np.array(cut), False)
    for before, after in machine.travels:
        # Either straight up, or above everything.
        assert before[:2] == after[:2] or min(before[2], after[2]) > top + 6.99
    assert machine.extruded == pytest.approx(0.05 * total, rel=1e-4)
    assert machine.feeds == {("G1", 900.0), ("G0", 3000.0)}


def test_gcode_of_a_flat_drawing_lies_at_the_origin(tmp_path):
    machine = Machine()
    values = {"layout_as": "top", "size": 80.0, "lift": 2.0}
    machine.run(written(tmp_path / "a.nc", values, flat()).decode("ascii"))
    cut = np.vstack(machine.cuts)
    assert np.allclose(cut.min(axis=0), 0.0) and cut[:, :2].max() == pytest.approx(80.0)
    assert machine.travels[0][1][2] == 2.0


@pytest.mark.parametrize("name", ["a.svg", "a.dxf", "a.gcode"])
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_bytes_are_the_same_again_and_free_of_exponents_and_locales(tmp_path, name, scale):
    laid = strands(scale) if name != "a.svg" else seen_along(strands(scale), *VIEWS["top"])
    values = {"scale": 0.1 / scale}
    once = written(tmp_path / name, values, laid)
    assert written(tmp_path / name, values, laid) == once
    assert not re.search(rb"\d[eE][-+]?\d|nan|inf|\d,\d", once.split(b"ENTITIES")[-1])
    before = locale.setlocale(locale.LC_NUMERIC)
    for other in ("de_DE.UTF-8", "fr_FR.UTF-8"):
        try:
            locale.setlocale(locale.LC_NUMERIC, other)
        except locale.Error:
            continue
        assert written(tmp_path / name, values, laid) == once
    locale.setlocale(locale.LC_NUMERIC, before)


def test_what_is_no_drawing_is_refused_and_the_file_is_as_it_was(tmp_path):
    broken = strands()
    broken[0].points[3, 1] = np.nan
    for laid, values, words in (
        ([], {}, "no strands"),
        (broken, {}, "not numbers"),
        ([toolpath.strand_of(np.ones((3, 3)), np.ones((3, 3)), True)], {"size": 9.0}, "one place"),
        ([toolpath.strand_of(np.ones((3, 3)), np.ones((3, 3)), True)], {}, "one place"),
        (strands(), {"unit": "cm"}, "millimetres and inches"),
    ):
        path = tmp_path / "a.gcode"
        path.write_text("earlier")
        kind, values = export.format_of(path), {**export.DEFAULTS, **values}
        with pytest.raises(FileError, match=words):
            drawing = export.prepared(laid, kind, values, 1.0)
            export.write(path, kind, drawing, values, "", "")
        assert path.read_text() == "earlier"


def test_the_scene_says_how_long_its_unit_is():
    drawing = drawing_of(strands(), "mm", metres=0.01, scale=2.0, size=0.0, flat=False)
    whole = sum(length_of(strand.points, strand.closed) for strand in strands())
    assert drawing.length == pytest.approx(20.0 * whole)
    text = "".join(gcode_pieces(drawing, Motion(), "caf\u00e9\nG28", "1"))
    assert text.startswith("; caf__G28, Meander 1\n")
