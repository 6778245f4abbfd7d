# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture as a sheet with its line: the sheet, its settings, and the tones of what is drawn."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from meander import batch
from meander.model.maps import png
from meander.scene import look
from meander.scene.picture import DIRECTION, SPACING, read_picture


@pytest.fixture
def ramp(tmp_path: Path) -> Path:
    """A picture, twice as wide as high, that is darker to the right, of 16 bits."""
    path = tmp_path / "ramp.png"
    values = np.tile(np.linspace(0.85, 0.2, 120), (60, 1))
    path.write_bytes(png((65535 * values).round().astype(np.uint16)))
    return path


def drawn(path: Path, **given: object) -> bpy.types.Object:
    asked = {"width": 60.0, "pen": 1.5, "tone": "VALUE"} | given
    assert bpy.ops.meander.picture(filepath=str(path), **asked) == {"FINISHED"}
    return bpy.context.view_layer.objects.active


def test_a_picture_is_read_as_it_is(ramp: Path) -> None:
    found = read_picture(ramp)
    assert found.sides == (120, 60) and found.opacity is None
    assert found.colours[5, :, 1] == pytest.approx(np.linspace(0.85, 0.2, 120), abs=1e-4)
    assert not bpy.data.images.keys() or "ramp" not in " ".join(bpy.data.images.keys())


def test_the_line_has_the_tones(ramp: Path) -> None:
    curve = drawn(ramp)
    assert curve.type == "CURVE"
    sheet = curve.meander.surface
    assert sheet.name.startswith("ramp")
    assert tuple(sheet.dimensions[:2]) == pytest.approx((0.06, 0.03))
    (points, cyclic), = scenes.world_splines(curve)
    assert cyclic
    ring = np.vstack([points, points[:1]])
    middle, steps = (ring[1:] + ring[:-1]) / 2, np.linalg.norm(np.diff(ring, axis=0), axis=1)
    # Ink over area in six columns of the sheet, without the outer ones.
    edges = np.linspace(-0.03, 0.03, 7)
    length = np.histogram(middle[:, 0], edges, weights=steps)[0]
    share = length * 0.0015 / (0.01 * 0.03)
    wanted = 1.0 - np.linspace(0.85, 0.2, 120).reshape(6, 20).mean(axis=1)
    assert share[1:-1] == pytest.approx(wanted[1:-1], abs=0.05)
    assert look.radius_of(curve) == pytest.approx(0.00075, rel=1e-3)


def test_the_sheet_is_all_that_is_made_where_it_is_not_filled(ramp: Path) -> None:
    sheet = drawn(ramp, fill=False, style="ENGRAVING")
    assert sheet.type == "MESH" and DIRECTION in sheet.data.attributes
    values = np.empty(len(sheet.data.vertices), dtype=np.float32)
    sheet.data.attributes[SPACING].data.foreach_get("value", values)
    spacing = values * sheet.meander.spacing * 1000.0
    assert 1.5 / spacing.min() == pytest.approx(0.8, abs=0.01)
    assert 1.5 / spacing.max() == pytest.approx(0.15, abs=0.01)
    assert sheet.meander.alignment_source == "ATTRIBUTE"


def test_units_of_the_scene_count(ramp: Path) -> None:
    bpy.context.scene.unit_settings.scale_length = 0.001
    assert tuple(drawn(ramp, fill=False).dimensions[:2]) == pytest.approx((60.0, 30.0))


def refused(path: object) -> str:
    before = scenes.counts()
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.meander.picture(filepath=str(path))
    assert scenes.counts() == before
    return str(caught.value)


def test_what_is_no_picture_is_refused(tmp_path: Path) -> None:
    assert "No picture is chosen; choose a file" in refused("")
    path = tmp_path / "a.png"
    path.write_text("x")
    images = len(bpy.data.images)
    assert "cannot be read as a picture; save it as" in refused(path)
    assert len(bpy.data.images) == images


def test_the_command_reads_pictures_without_pillow(ramp: Path, tmp_path: Path, monkeypatch) -> None:
    from meander.cli import place

    monkeypatch.setattr(place, "is_there", lambda: False)
    out = tmp_path / "out.svg"
    words = ("--picture", ramp, "--width", 30, "--pen", 1.5, "--output", out, "--quiet")
    assert batch.main([str(word) for word in words]) == 0
    assert 'width="30mm" height="15mm"' in out.read_text()
