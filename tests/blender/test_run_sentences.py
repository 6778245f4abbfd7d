# SPDX-License-Identifier: GPL-3.0-or-later
"""Every sentence of the table that runs, and the batch command in Blender, have comes up here."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np
import pytest
from meander import batch, core
from meander.cli.values import BadInput
from meander.headless import scene_output
from meander.run import cut, estimate, images, live, makers, motion
from meander.run.plan import plan_run
from meander.scene import points
from meander.scene.errors import DataError
from said_sentences import OF_SCENES, missing, sentences
from scenes import activate, circle_points, cube, fill, grid, poly_curve, refused, sphere
from sentences import assert_sentence
from watched_runs import begin, tick_until

HERE = Path(__file__).parent
MODULES = [path for path in OF_SCENES if path.parent.name != "scene"]

# A part of the sentence, and what test_camera_drawing.py quotes of it.
OF_DRAWINGS = {
    "camera sees no surface": "camera sees no surface; turn",
    "is seen edge on": "is seen edge on; turn it",
    "The scene has no light; add": "The scene has no light; add a lamp",
    "is for --tone; give both": "is for --tone; give both or none",
    "--tone and --spacing are both": "--tone and --spacing are both given",
    "--lightest is not less than": "--lightest is not less than",
    "Nothing is drawn: ": "Nothing is drawn: ",
    "leave nothing of the page": "the margins leave nothing of",
    "is no .svg file": "is no .svg file",
    "the scene has no object": "the scene has no object",
    "a camera sees is one page": "is one page; give a larger --paper",
    " would overwrite ": "overwrite the scene",
}

# Tried elsewhere: a part of the sentence, and what test_instances.py quotes of it.
OF_INSTANCES = {"are one mesh for a cut": "Instances that touch are one mesh for a cut"}


class Said:
    def __init__(self, folder: Path, capsys: pytest.CaptureFixture) -> None:
        self.folder, self.capsys = folder, capsys
        self.lines: list[str] = []

    def by(self, call: Callable[[], object]) -> None:
        with pytest.raises((DataError, core.MeanderError, BadInput)) as refusal:
            call()
        self.lines.append(str(refusal.value))

    def by_the_command(self, *arguments: object) -> None:
        """On the scene as it is."""
        scene = self.folder / "scene.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(scene), check_existing=False, copy=True)
        self.of_file(scene, *arguments)

    def of_file(self, path: Path, *arguments: object) -> None:
        given = ("--input", path, "--spacing", 0.5, "--iterations", 1, "--quiet", *arguments)
        if "--output" not in arguments:
            given = (*given, "--output", self.folder / "out.obj")
        self.capsys.readouterr()
        assert batch.main([str(one) for one in given]) == 2
        self.lines.append(self.capsys.readouterr().err.strip().removeprefix("meander: "))


@pytest.fixture
def said(tmp_path: Path, capsys: pytest.CaptureFixture) -> Said:
    return Said(tmp_path, capsys)


def depsgraph() -> bpy.types.Depsgraph:
    return bpy.context.evaluated_depsgraph_get()


def of_plans(said: Said) -> None:
    said.lines.append(refused(grid(), use_outline=True, border_distance=0.05))
    surface = sphere()
    result = fill(surface, 0.5)
    bpy.context.scene.collection.objects.unlink(surface)
    said.lines.append(refused(result))
    sheet = grid()
    result = fill(sheet, 0.3, use_outline=True)
    assert result.meander.figures.guides
    result.meander.guides = poly_curve("Drawn", [circle_points(0.3, 0.0)], cyclic=True)
    said.lines.append(refused(result))


def of_growing(said: Said) -> None:
    surface = sphere()
    running = begin(surface, 0.3)
    with pytest.raises(DataError) as refusal:
        bpy.data.objects.remove(surface)
        tick_until(running, lambda: False)
    said.lines.append(str(refusal.value))
    running.end()
    result = fill(sphere(), 0.5)
    running = begin(result, 0.3)
    with pytest.raises(DataError) as refusal:
        bpy.data.objects.remove(result)
        tick_until(running, lambda: False)
    said.lines.append(str(refusal.value))
    running.end()


def of_live(said: Said) -> None:
    surface = cube()
    running = begin(surface, 0.5)
    most = 2 * estimate.of_plan(running.plan).points
    running.is_large = lambda estimate: estimate.points > most
    surface.meander.live, surface.meander.spacing = True, 0.1
    assert not running.find_wish(bpy.context, surface)
    said.lines.append(running.refusal)
    running.suspend()
    plan = plan_run(bpy.context)
    surface.modifiers.new("More", "SUBSURF")
    surface.meander.density_source = "CURVATURE"
    surface.meander.density_source, surface.meander.density_group = "GROUP", "Painted"
    surface.vertex_groups.new(name="Painted")
    said.by(lambda: live.wish_of(surface, plan, None, depsgraph()))


def of_motion(said: Said) -> None:
    surface = sphere()
    result = fill(surface, 0.3)
    said.by(lambda: motion._same_faces(np.zeros((2, 3)), np.zeros((3, 3))))
    faces = np.array([[0, 1, 2], [2, 1, 3]])
    said.by(lambda: motion._same_faces(faces + 9, faces))
    result.meander.motion, result.meander.figures.bridges = "EVEN", "some"
    said.by(lambda: motion.follower_of(result, bpy.context.scene, depsgraph()))
    said.by(lambda: scene_output._bake(argparse.Namespace(bake_frames=(1, 2), round=None), result))
    result.meander.figures.bridges = ""
    surface.data.transform(np.diag([0.01, 0.01, 1.0, 1.0]))
    said.by(lambda: motion.follower_of(result, bpy.context.scene, depsgraph()))
    said.by(lambda: cut.cut_result(result, bpy.context.scene, depsgraph()))


def of_cuts(said: Said) -> None:
    result = fill(grid(), 0.4)
    figures = result.meander.figures
    figures.first_guide, figures.guides = 0, figures.strands
    said.by(lambda: cut.cut_result(result, bpy.context.scene, depsgraph()))


def of_makers(said: Said) -> None:
    sheet = grid(cells=8)
    sheet.meander.seed = poly_curve("Stroke", [[(-0.5, 0.0, 0.0), (0.5, 0.0, 0.0)]], False)
    open_one = fill(sheet, 0.4)
    values = {name: 0.1 for name in makers.MAKERS["maze"].values} | {"doors": "NONE"}
    said.by(lambda: makers.make("maze", values, open_one, bpy.context.scene, depsgraph()))
    places = sheet.data.uv_layers.active or sheet.data.uv_layers.new()
    for moved in (lambda u, v: (2.0 * u, v), lambda u, v: (0.5, 0.5)):
        for place in places.data:
            place.uv = moved(*place.uv)
        said.by(lambda: images.make_material(open_one, bpy.context, "GLAZE", 64))


def of_the_command(said: Said) -> None:
    scene = said.folder / "none.blend"
    scene.write_text("no scene")
    said.of_file(scene)
    said.by_the_command()
    thing = cube()
    for layer in list(thing.data.uv_layers):
        thing.data.uv_layers.remove(layer)
    said.by_the_command("--object", "None")
    said.by_the_command("--seed-object", "None")
    svg = said.folder / "out.svg"
    said.by_the_command("--output", svg, "--layout", "uv")
    said.by_the_command("--maps", said.folder / "line.png")
    cube()
    activate(None)
    said.by_the_command()
    said.by(lambda: scene_output._save(said.folder / "none" / "out.blend", Path("out.blend")))


def of_points(said: Said, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_kind: str) -> None:
        raise DataError("hair curves need Blender 4.2; choose a mesh")  # in this one or in that

    with monkeypatch.context() as patched:
        patched.setattr(points, "refuse", refuse)
        said.by(lambda: scene_output.refuse_points("curves"))


def test_every_sentence_of_runs_comes_up(said, monkeypatch, windowed):
    of_points(said, monkeypatch)
    for part in (of_plans, of_growing, of_live, of_motion, of_cuts, of_makers, of_the_command):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        part(said)
    for line in said.lines:
        assert_sentence(line)
    assert missing(MODULES, said.lines, OF_DRAWINGS | OF_INSTANCES) == []
    elsewhere = {"test_camera_drawing.py": OF_DRAWINGS, "test_instances.py": OF_INSTANCES}
    for name, parts in elsewhere.items():
        quoting = (HERE / name).read_text(encoding="utf-8")
        assert [quoted for quoted in parts.values() if quoted not in quoting] == []
    assert len(sentences(MODULES)) > 20
