# SPDX-License-Identifier: GPL-3.0-or-later
"""What a camera draws on a page: spacing on paper, what hides what, layers, the command."""

from __future__ import annotations

import json
import math
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from types import MethodType, SimpleNamespace

import bpy
import meander
import numpy as np
import pytest
import scenes
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector
from meander import core
from meander.headless import camera as draw
from meander.model.camera import PAPERS, Page
from meander.run.camera import CameraDrawing, Going, going
from meander.run.paper import DrawingEstimate
from meander.scene.camera import camera_page
from meander.ui import camera as camera_operator
from panel_layout import Layout
from watched_runs import FakeWindow

SVG = "{http://www.w3.org/2000/svg}"
LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
PAGE = Page(*PAPERS["a4"], 15.0)


def camera(location: tuple, target: tuple = (0.0, 0.0, 0.0)) -> bpy.types.Object:
    """The scene's camera, whose picture is 3 wide and 2 high."""
    thing = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    thing.location = location
    thing.rotation_euler = (Vector(target) - thing.location).to_track_quat("-Z", "Y").to_euler()
    scene = bpy.context.scene
    scene.collection.objects.link(thing)
    scene.camera = thing
    scene.render.resolution_x, scene.render.resolution_y = 600, 400
    bpy.context.view_layer.update()
    return thing


def frame() -> object:
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return camera_page(bpy.context.scene, depsgraph, bpy.context.scene.camera, PAGE)


def plane(name: str, size: float, location: tuple, angle: float = 0.0) -> bpy.types.Object:
    """A square that faces -y, leaning back by an angle."""
    bpy.ops.mesh.primitive_plane_add(size=size, location=location)
    thing = scenes.activate(bpy.context.active_object)
    thing.name = name
    thing.rotation_euler.x = math.radians(90.0) - angle
    bpy.context.view_layer.update()
    return thing


def drawn(path: Path, spacing: float, **given: object) -> dict[str, list[np.ndarray]]:
    """Draws: the paths of every layer, closed ones with their first point again at the end, in
    millimetres from the upper left corner."""
    made = bpy.ops.meander.draw_camera(filepath=str(path), spacing=spacing, **given)
    assert made == {"FINISHED"}
    return layers_of(path)


def layers_of(path: Path) -> dict[str, list[np.ndarray]]:
    layers = {}
    for layer in ElementTree.parse(path).getroot().iter(f"{SVG}g"):
        if layer.get(LABEL) is None:
            continue
        assert layer.get(LABEL) not in layers
        paths = layers[layer.get(LABEL)] = []
        for element in layer:
            numbers = [float(text) for text in re.findall(r"-?\d+\.?\d*", element.get("d"))]
            points = np.array(numbers).reshape(-1, 2)
            closed = element.get("d").endswith("Z")
            paths.append(np.vstack([points, points[:1]]) if closed else points)
    return layers


def steps_of(paths: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Middles and lengths of all straight pieces."""
    middles = np.vstack([(path[1:] + path[:-1]) / 2.0 for path in paths])
    return middles, np.concatenate([np.linalg.norm(np.diff(p, axis=0), axis=1) for p in paths])


def refused(path: Path, **given: object) -> str:
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.meander.draw_camera(filepath=str(path), **given)
    assert not path.exists()
    return str(caught.value).removeprefix("Error: ").strip()


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_points_lie_where_the_picture_has_them(kind: str) -> None:
    eye = camera((3.0, -6.0, 4.0))
    eye.scale = (2.0, 1.0, 0.5)  # which pictures do not care for
    eye.data.type, eye.data.ortho_scale = kind, 5.0
    eye.data.shift_x, eye.data.shift_y = 0.1, -0.07
    eye.data.sensor_fit = "VERTICAL"
    bpy.context.scene.render.pixel_aspect_y = 1.5
    bpy.context.view_layer.update()
    page = frame()
    points = np.random.default_rng(1).uniform(-1.0, 1.0, (20, 3))
    found = (page.on_paper(points) - page.corner) / page.sides
    eye.scale = (1.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    for point, place in zip(points, found, strict=True):
        wanted = world_to_camera_view(bpy.context.scene, eye, Vector(point))
        if kind == "PERSP":
            eye_to = page.depths([point])[0]
            assert eye_to == pytest.approx(wanted.z, rel=1e-5)
        assert place == pytest.approx(wanted[:2], abs=1e-4)
    assert page.aspect == pytest.approx(1.0) and page.page.width == 210.0


def test_the_spacing_is_the_one_on_paper_whatever_the_distance(tmp_path: Path) -> None:
    camera((0.0, -10.0, 0.0))
    plane("Near", 1.2, (-0.9, -5.0, 0.0))
    plane("Far", 3.6, (2.7, 5.0, 0.0))
    found = drawn(tmp_path / "a.svg", 4.0, report_too=True)
    page = frame()
    for name in ("Near", "Far"):
        thing = bpy.data.objects[name]
        corners = page.on_paper([thing.matrix_world @ v.co for v in thing.data.vertices])
        area = np.prod(np.ptp(corners, axis=0))
        length = steps_of(found[name])[1].sum()
        assert length * 4.0 / area == pytest.approx(1.0, abs=0.06)
    record = json.loads((tmp_path / "a.json").read_text())
    by_name = {each["name"]: each["spacing"]["least"] for each in record["objects"]}
    assert by_name["Far"] / by_name["Near"] == pytest.approx(3.0, rel=1e-6)
    assert record["crossings"] == 0 and record["spacing"] == 4.0
    paths = [path for layer in found.values() for path in layer]
    assert record["paths"] == len(paths)
    assert record["length"] == pytest.approx(steps_of(paths)[1].sum(), rel=1e-4)


def test_the_spacing_grows_with_the_distance_within_one_object(tmp_path: Path) -> None:
    eye = camera((0.0, -6.0, 0.0))
    slope = plane("Slope", 8.0, (0.0, 1.0, 0.0), math.radians(65.0))
    found = drawn(tmp_path / "a.svg", 8.0)["Slope"]
    page = frame()
    # Back from paper onto the plane, by the picture's own geometry.
    middles, _ = steps_of(found)
    starts = np.vstack([path[:-1] for path in found])
    ends = np.vstack([path[1:] for path in found])
    normal = np.array(slope.matrix_world.to_3x3() @ Vector((0.0, 0.0, 1.0)))
    width = eye.data.sensor_width / eye.data.lens

    def unprojected(paper: np.ndarray) -> np.ndarray:
        share = (paper - [148.5, 105.0]) / page.sides[0] * width
        rays = np.column_stack([share[:, 0], np.ones(len(paper)), -share[:, 1]])
        origin = np.array(eye.location)
        t = ((np.array(slope.location) - origin) @ normal) / (rays @ normal)
        return origin + t[:, None] * rays

    on_plane = unprojected(middles)
    lengths = np.linalg.norm(unprojected(ends) - unprojected(starts), axis=1)
    depth = on_plane[:, 1] + 6.0
    local = 8.0 * depth * width / page.sides[0]  # what the spacing is in the scene
    bounds = np.quantile(depth, [0.02, 0.3, 0.6, 0.98])
    assert bounds[-1] > 1.8 * bounds[0]
    along = np.array(slope.matrix_world.to_3x3() @ Vector((0.0, 1.0, 0.0)))
    for low, high in zip(bounds[:-1], bounds[1:]):
        inside = (depth >= low) & (depth < high)
        # Of that strip of the plane, what the frame holds, or the plane ends.
        steps = np.linspace(low, high, 200)
        wide = np.minimum(steps * width, 8.0)
        area = wide.mean() * (high - low) / abs(along[1])
        assert (lengths * local)[inside].sum() / area == pytest.approx(1.0, abs=0.09)


def test_what_another_object_hides_is_left_out(tmp_path: Path) -> None:
    camera((0.0, -8.0, 0.0))
    plane("Wall", 5.0, (0.0, 1.0, 0.0))
    bpy.ops.mesh.primitive_cube_add(size=1.2)
    cube = scenes.activate(bpy.context.active_object)
    cube.name = 'Cube & "Co"'
    found = drawn(tmp_path / "a.svg", 10.0)
    assert set(found) == {"Wall", 'Cube & "Co"'}
    page = frame()
    front = page.on_paper([[x, -0.6, z] for x in (-0.6, 0.6) for z in (-0.6, 0.6)])
    low, high = front.min(axis=0), front.max(axis=0)
    high_y = 210.0 - low[1], 210.0 - high[1]

    def within(paths: list[np.ndarray], by: float) -> np.ndarray:
        points = np.vstack(paths)
        beyond = (points - [low[0] - by, high_y[1] - by]).min(axis=1)
        return (beyond > 0.0) & (([high[0] + by, high_y[0] + by] - points).min(axis=1) > 0.0)

    assert within(found["Wall"], -0.05).sum() == 0
    ends = np.vstack([path[[0, -1]] for path in found["Wall"]])
    at_cube = within([ends], 0.02)
    assert at_cube.sum() > 10, "strands end where the cube begins to hide them"
    assert within(found['Cube & "Co"'], 0.02).all()
    # A holdout hides, and is not drawn.
    cube.is_holdout = True
    held = drawn(tmp_path / "b.svg", 10.0)
    assert set(held) == {"Wall"}
    assert all(map(np.array_equal, held["Wall"], found["Wall"]))
    # One that is not rendered does neither.
    cube.is_holdout, cube.hide_render = False, True
    bare = drawn(tmp_path / "c.svg", 10.0)
    assert set(bare) == {"Wall"} and within(bare["Wall"], -0.05).sum() > 100


def test_outlines_are_layers_of_what_is_seen_of_them(tmp_path: Path) -> None:
    eye = camera((0.0, -30.0, 0.0))
    eye.data.type, eye.data.ortho_scale = "ORTHO", 4.0
    for name, place in (("Front", (-0.5, -3.0, 0.0)), ("Back", (0.5, 3.0, 0.0))):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=0.8, location=place)
        scenes.activate(bpy.context.active_object).name = name
        bpy.ops.object.shade_smooth()
    found = drawn(tmp_path / "a.svg", 9.0, use_outlines=True, report_too=True)
    assert set(found) == {"Front", "Front Outline", "Back", "Back Outline"}
    unit = frame().sides[0] / 4.0
    middle = np.array([297.0, 210.0]) / 2.0
    (front,), back = found["Front Outline"], found["Back Outline"]
    for paths, place in (([front], -0.5), (back, 0.5)):
        points = np.vstack(paths) - middle - [place * unit, 0.0]
        assert np.linalg.norm(points, axis=1) == pytest.approx(0.8 * unit, rel=0.02)
    assert np.array_equal(front[0], front[-1]), "in front it is whole"
    # Behind, the arc within the other circle is hidden.
    hidden = 2.0 * math.acos(0.5 / 0.8) / (2.0 * math.pi)
    share = steps_of(back)[1].sum() / (2.0 * math.pi * 0.8 * unit)
    assert share == pytest.approx(1.0 - hidden, abs=0.03)
    record = json.loads((tmp_path / "a.json").read_text())
    assert record["outlines"] == 1 + len(back) and record["crossings"] == 0


def test_a_scene_without_light_is_refused(tmp_path: Path) -> None:
    camera((0.0, -8.0, 0.0))
    plane("Plane", 2.0, (0.0, 0.0, 0.0))
    bpy.context.scene.world = None
    said = refused(tmp_path / "a.svg", use_tone=True)
    assert said == "The scene has no light; add a lamp, or leave Tone off"


def test_nothing_leaves_the_frame(tmp_path: Path) -> None:
    camera((0.3, -3.0, 1.2))
    floor = plane("Floor", 60.0, (0.0, 0.0, 0.0))
    floor.rotation_euler.x = 0.0
    scenes.activate(floor)
    camera_data = bpy.context.scene.camera.data
    camera_data.clip_end = 12.0
    found = drawn(tmp_path / "a.svg", 10.0, paper="CUSTOM", width=120.0, height=200.0, margin=20.0)
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    assert root.get("viewBox") == "0 0 200 120"
    points = np.vstack(found["Floor"])
    sides = np.array([120.0, 80.0])
    low = (np.array([200.0, 120.0]) - sides) / 2.0
    assert (points >= low - 1e-3).all() and (points <= low + sides + 1e-3).all()
    # It is filled up to the frame's left, right and lower sides, and not beyond the far end.
    reach = [points[:, 0].min() - low[0], low[0] + sides[0] - points[:, 0].max()]
    reach.append(low[1] + sides[1] - points[:, 1].max())
    assert max(reach) < 10.0


def test_a_floor_that_reaches_far_away_is_drawn(
    tmp_path: Path, capfd: pytest.CaptureFixture
) -> None:
    """From half a metre to 60: densities on it would vary by more than the library takes."""
    eye = camera((0.0, -30.0, 0.4), (0.0, 30.0, 0.0))
    eye.data.lens = 12.0
    floor = plane("Floor", 60.0, (0.0, 0.0, 0.0))
    floor.rotation_euler.x = 0.0
    scenes.activate(floor)
    found = drawn(tmp_path / "a.svg", 10.0)
    assert "its far end is drawn closer than the spacing" in capfd.readouterr().out
    assert set(found) == {"Floor"}
    points = np.vstack(found["Floor"])
    assert np.ptp(points[:, 0]) > 200.0 and np.ptp(points[:, 1]) > 60.0


def test_a_drawing_that_fails_on_the_way_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """And while it goes on nothing else can begin."""

    class Failing:
        finished = False

        def prepare(self) -> None:
            pass

        def poll(self) -> None:
            raise core.MeanderError("There is not enough memory", core.Status.OUT_OF_MEMORY)

        def cancel(self) -> None:
            pass

        def join(self) -> None:
            pass

    camera((0.0, -9.0, 0.0))
    thing = scenes.sphere()
    operator = camera_operator.MEANDER_OT_draw_camera
    window = FakeWindow(bpy.context)
    going.begin(Going(SimpleNamespace(), Failing(), window))
    scenes.activate(thing)
    assert not operator.poll(bpy.context) and not bpy.ops.meander.run.poll()
    said = []
    this = SimpleNamespace(options=SimpleNamespace(is_invoke=False))
    this.report = lambda kinds, text: said.append(text)
    this.cancel = lambda context: operator.cancel(this, context)
    this.going_on = operator.going_on
    this._tick = lambda context, going: operator._tick(this, context, going)
    event = SimpleNamespace(type="TIMER", value="NOTHING")
    assert operator.modal(this, bpy.context, event) == {"CANCELLED"}
    assert said == ["There is not enough memory"]
    assert going.current is None and window.texts == [None]
    assert operator.poll(bpy.context) and bpy.ops.meander.run.poll()


def test_instances_are_drawn_and_curves_of_ours_are_not(tmp_path: Path) -> None:
    camera((0.0, -9.0, 0.0))
    ball = scenes.sphere(0.8)
    ball.name, ball.location = "Ball", (-2.0, 0.0, 0.0)
    group = bpy.data.collections.new("Group")
    group.objects.link(ball)
    shown = bpy.data.objects.new("Copy", None)
    shown.instance_type, shown.instance_collection = "COLLECTION", group
    shown.scale.x = -1.0  # its faces still face outward
    bpy.context.scene.collection.objects.link(shown)
    result = scenes.fill(ball, 0.3)
    result.data.bevel_depth = 0.1
    before = scenes.counts(), [thing.name for thing in bpy.context.scene.objects]
    found = drawn(tmp_path / "a.svg", 7.0)
    assert set(found) == {"Ball", "Copy: Ball"}
    length = [steps_of(found[name])[1].sum() for name in found]
    assert length[0] == pytest.approx(length[1], rel=0.15)
    assert (scenes.counts(), [thing.name for thing in bpy.context.scene.objects]) == before
    ball.hide_set(True)
    assert set(drawn(tmp_path / "b.svg", 7.0)) == {"Copy: Ball"}


def test_an_object_keeps_its_direction_and_density(tmp_path: Path) -> None:
    camera((0.0, -8.0, 0.0))
    left = plane("Left", 2.0, (-1.2, 0.0, 0.0))
    right = plane("Right", 2.0, (1.2, 0.0, 0.0))
    left.meander.alignment_source, left.meander.alignment_axis = "AXIS", "X"
    left.meander.alignment_weight = 3.0
    group = right.vertex_groups.new(name="Fine")
    group.add([0, 1, 2, 3], 1.0, "REPLACE")
    right.meander.density_group = "Fine"
    right.meander.factor_0, right.meander.factor_1 = 1.0, 0.5
    scenes.activate(left)
    found = drawn(tmp_path / "a.svg", 6.0)
    steps = np.vstack([np.diff(path, axis=0) for path in found["Left"]])
    across = np.abs(steps[:, 0]).sum() / np.linalg.norm(steps, axis=1).sum()
    assert across > 0.85, "rows along x"
    packed = {name: steps_of(found[name])[1].sum() for name in found}
    assert packed["Right"] / packed["Left"] == pytest.approx(2.0, rel=0.15)


def test_what_cannot_be_filled_is_left_out_and_said(
    tmp_path: Path, capfd: pytest.CaptureFixture
) -> None:
    camera((0.0, -8.0, 0.0))
    plane("Good", 2.0, (-1.2, 0.0, 0.0))
    bad = plane("Bad", 2.0, (1.2, 0.0, 0.0))
    bad.meander.density_source, bad.meander.density_attribute = "ATTRIBUTE", "nowhere"
    found = drawn(tmp_path / "a.svg", 4.0, report_too=True)
    assert set(found) == {"Good"}
    said = capfd.readouterr().out
    assert "'Bad' is left out:" in said and "nowhere" in said
    figures = json.loads((tmp_path / "a.json").read_text())["objects"]
    assert [("left_out" in each) for each in figures] == [True, False]
    bpy.data.objects.remove(bpy.data.objects["Good"])
    sentence = refused(tmp_path / "b.svg", spacing=4.0)
    assert sentence.startswith("Nothing is drawn: 'Bad' is left out")
    assert "choose a smaller spacing" in sentence


def test_a_plane_that_is_seen_edge_on_is_left_out_and_said(
    tmp_path: Path, capfd: pytest.CaptureFixture
) -> None:
    camera((0.0, -8.0, 0.0))
    plane("Good", 2.0, (-1.2, 0.0, 0.0))
    plane("Flat", 2.0, (1.2, 0.0, 0.0), math.radians(90.0))
    plane("Nearly", 2.0, (1.2, 0.0, 0.6), math.radians(70.0))
    assert set(drawn(tmp_path / "a.svg", 4.0)) == {"Good", "Nearly"}
    assert "'Flat' is seen edge on; turn it" in capfd.readouterr().out


def test_refusals(tmp_path: Path) -> None:
    path = tmp_path / "a.svg"
    scenes.cube()
    assert not bpy.ops.meander.draw_camera.poll()
    eye = camera((0.0, -8.0, 0.0))
    assert "leave nothing of the page" in refused(path, margin=105.0)
    with pytest.raises(RuntimeError, match="No file is named"):
        bpy.ops.meander.draw_camera(filepath="")
    eye.rotation_euler.x += math.pi
    bpy.context.view_layer.update()
    assert "camera sees no surface; turn" in refused(path)
    eye.rotation_euler.x -= math.pi
    bpy.context.view_layer.update()
    tiny = bpy.context.scene.objects["Cube"]
    tiny.scale = (0.001, 0.001, 0.001)
    assert "Nothing is drawn: " in refused(path)
    tiny.scale = (1.0, 1.0, 1.0)
    eye.data.type = "PANO"
    assert "takes panoramas, which no page" in refused(path)
    bpy.context.scene.camera = tiny
    assert "is no camera; make a camera" in refused(path)
    with pytest.raises(RuntimeError, match="cannot be written"):
        bpy.context.scene.camera = eye
        eye.data.type = "PERSP"
        bpy.ops.meander.draw_camera(filepath=str(tmp_path / "none" / "a.svg"), spacing=9.0)
    assert not list(tmp_path.iterdir())


def saved(tmp_path: Path) -> Path:
    camera((0.0, -8.0, 0.0))
    bpy.ops.mesh.primitive_uv_sphere_add()
    return scenes.saved(tmp_path / "scene.blend")


def run_command(*arguments: object, scene: Path) -> subprocess.CompletedProcess:
    """In a Blender of its own, as the page says."""
    script = Path(meander.__file__).parent / "camera.py"
    if bpy.app.binary_path:
        command = [bpy.app.binary_path, "--background", "--factory-startup", str(scene)]
        command += ["--python-exit-code", "1", "--python", str(script), "--"]
    else:
        command = [sys.executable, str(script), "--", "--input", str(scene)]
    return subprocess.run(
        [*command, *map(str, arguments)], capture_output=True, text=True, timeout=120
    )


def estimate(spacing: float) -> DrawingEstimate:
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return CameraDrawing(frame(), spacing, depsgraph).estimate()


def test_what_a_drawing_comes_to_is_known_before(tmp_path: Path) -> None:
    camera((0.0, -10.0, 0.0))
    plane("Near", 1.2, (-0.9, -5.0, 0.0))
    slope = plane("Slope", 8.0, (0.0, 5.0, 0.0), math.radians(60.0))
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1.0, location=(1.0, 0.0, 0.5))
    slope.meander.preset = "PAPER"
    width = float(frame().sides[0])
    for spacing in (10.0, 7.0):
        expected = estimate(spacing).at(spacing, width)
        drawn(tmp_path / "a.svg", spacing, report_too=True)
        objects = json.loads((tmp_path / "a.json").read_text())["objects"]
        points = sum(each["nodes"] for each in objects)
        assert estimate(spacing).cost().nodes == pytest.approx(points, rel=1.0 / 3.0)
        # Measured once, it is known for every spacing and every page.
        assert estimate(4.0).at(spacing, width).points == pytest.approx(expected.points, rel=0.1)
        assert estimate(4.0).at(2.0 * spacing, 2.0 * width).points == pytest.approx(
            estimate(4.0).at(spacing, width).points
        )


def test_the_dialog_says_what_the_page_comes_to() -> None:
    camera((0.0, -10.0, 0.0))
    plane("Near", 1.2, (-0.9, -5.0, 0.0))
    chosen = {"spacing": 2.0, "paper": "A4", "width": 200.0, "height": 200.0, "margin": 15.0}
    texts = []
    for more in ({}, {"spacing": 1.0}, {"paper": "A3", "margin": 30.0 * math.sqrt(0.5)}):
        dialog = SimpleNamespace(
            **chosen | more, line_width=0.3, report_too=False, use_tone=False, layout=Layout(),
            _size=estimate(3.0), bl_rna=bpy.ops.meander.draw_camera.get_rna_type(),
        )  # fmt: skip
        for name in ("_frame", "_expected"):
            method = getattr(camera_operator.MEANDER_OT_draw_camera, name)
            setattr(dialog, name, MethodType(method, dialog))
        camera_operator.MEANDER_OT_draw_camera.draw(dialog, bpy.context)
        (text,) = (each.text for each in dialog.layout.texts() if each.text.startswith("About"))
        texts.append(text)
    counts = [int(text.split()[1].replace(",", "")) for text in texts]
    assert counts[1] == pytest.approx(4 * counts[0], rel=0.1)
    assert counts[2] == pytest.approx(2 * counts[0], rel=0.1)


def test_the_command_says_what_it_will_take_and_refuses_too_much(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    saved(tmp_path)
    output = tmp_path / "a.svg"
    given = ["--output", str(output), "--spacing", "8"]
    capsys.readouterr()
    assert draw.main([*given, "--limit-nodes", "10"]) == 2
    said = capsys.readouterr()
    assert re.match(r"meander: about [\d,]+ points, \d+ s, \d+ MB\n", said.out)
    assert re.fullmatch(
        r"meander: the run would need about [\d,]+ nodes, .*, and --limit-nodes is 10; choose a "
        r"larger spacing, or raise --limit-nodes\n",
        said.err,
    )
    assert not output.exists()
    assert draw.main(given) == 0 and output.exists()
    assert capsys.readouterr().out.startswith("meander: about ")


def test_the_command_draws_the_same(tmp_path: Path) -> None:
    scene, output, report = saved(tmp_path), tmp_path / "a.svg", tmp_path / "a.json"
    given = ("--output", output, "--spacing", 8, "--paper", "a5", "--margin", 10)
    done = run_command(*given, "--report", report, scene=scene)
    assert done.returncode == 0, done.stderr
    assert "1 of 1, Sphere:" in done.stdout and f"wrote {output}" in done.stdout
    assert json.loads(report.read_text())["page"] == {"width": 210, "height": 148, "margin": 10}
    drawn(tmp_path / "b.svg", 8.0, paper="A5", margin=10.0)
    assert output.read_bytes() == (tmp_path / "b.svg").read_bytes()
    refusal = run_command(*given, "--camera", "Nobody", scene=scene)
    assert refusal.returncode == 2 and refusal.stderr.startswith("meander: the scene has no object")


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (("--paper", "a9"), "is no paper; choose from"),
        (("--paper", "0x5"), "is no paper; choose from"),
        (("--margin", "105"), "the margins leave nothing of"),
        (("--output", "a.pdf"), "is no .svg file"),
        (("--camera", "Nobody"), "has no object 'Nobody'; give the name of a camera"),
        (("--input", "none.blend"), "--input none.blend does not exist; check the path"),
        (("--input", __file__), "is no .blend file that Blender"),
        (("--input", "/"), "is a folder; name a file in it"),
        (("--input", ""), "it is empty; give the name of a file"),
        (("--output", "none/a.svg"), "the folder of --output none/a.svg does not exist"),
        (("--output", f"{'x' * 300}.svg"), "cannot be used (File name too long)"),
        (("--report", "/"), "--report / is a folder; give a file name"),
        (("--report", "none/a.json"), "the folder of --report none/a.json does not exist"),
        (("--sheet", "a4"), "is one page; give a larger --paper"),
        (("--spacing", "0"), "is out of range"),
        (("--tone", "eye"), "--tone and --spacing are both given; choose one"),
        (("--darkest", "0.5"), "--darkest is for --tone; give both or none"),
    ],
)
def test_the_command_refuses(
    tmp_path: Path, capsys: pytest.CaptureFixture, given: tuple, sentence: str
) -> None:
    saved(tmp_path)
    output = tmp_path / "a.svg"
    assert draw.main(["--output", str(output), "--spacing", "3", *given]) == 2
    said = capsys.readouterr().err
    assert sentence in said and said.count("\n") == 1
    assert not output.exists()


def test_the_command_writes_over_nothing_that_it_reads(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    scene, output = saved(tmp_path), tmp_path / "a.svg"
    before = scene.read_bytes()
    given = ["--output", str(output), "--spacing", "8", "--report"]
    for more in (["--input", str(scene)], []):  # the file that is open, too
        for report, words in ((scene, "overwrite the scene"), (output, "overwrite --output")):
            assert draw.main([*given, str(report), *more]) == 2
            assert words in capsys.readouterr().err
    assert scene.read_bytes() == before and not output.exists()


def test_the_command_draws_the_light(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    saved(tmp_path)
    output = tmp_path / "a.svg"
    given = ["--output", str(output), "--paper", "a5", "--line-width", "3", "--quiet"]
    toned = [*given, "--tone", "light"]
    assert draw.main([*toned, "--lightest", "0.5", "--darkest", "0.4"]) == 2
    assert "--lightest is not less than --darkest" in capsys.readouterr().err
    lamp = bpy.data.lights.new("Sun", "SUN")
    thing = bpy.data.objects.new("Sun", lamp)
    thing.rotation_euler.x = math.radians(90.0)  # it shines along y, as the camera looks
    bpy.context.scene.collection.objects.link(thing)
    lengths = []
    for lamp.energy in (0.5, 2.5):
        assert draw.main(toned) == 0
        paths = [path for layer in layers_of(output).values() for path in layer]
        lengths.append(steps_of(paths)[1].sum())
    assert lengths[1] < 0.7 * lengths[0], "more light, less line"


def test_the_command_takes_a_frame_and_a_camera(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    saved(tmp_path)
    ball, scene = bpy.data.objects["Sphere"], bpy.context.scene
    ball.location.x = 0.0
    ball.keyframe_insert("location", frame=1)
    ball.location.x = 30.0
    ball.keyframe_insert("location", frame=20)
    scene.frame_set(20)
    other = scene.camera
    other.name = "Side"
    scene.camera = None
    output = tmp_path / "a.svg"
    given = ["--output", str(output), "--spacing", "6", "--quiet"]
    assert draw.main(given) == 2
    assert "has no camera; add one" in capsys.readouterr().err
    assert draw.main([*given, "--camera", "Side"]) == 2, "at frame 20 it is out of sight"
    assert draw.main([*given, "--camera", "Side", "--frame", "1"]) == 0
    assert set(layers_of(output)) == {"Sphere"}
