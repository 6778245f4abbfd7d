# SPDX-License-Identifier: GPL-3.0-or-later
"""What the batch command does with a .blend of strangers, and with a .blend that it cannot write:
no Python in it is run unless asked for, and what was there stays."""

from __future__ import annotations

import json
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import bpy
import meander
import pytest
from meander import batch
from meander.headless.scene_output import is_whole
from meander.jobs.objects import Meshes
from scenes import saved, sphere

ADDON = Path(meander.__file__).parents[1]


@pytest.fixture
def marker(tmp_path: Path) -> Path:
    """A file that is there once Python of the scene was run."""
    return tmp_path / "it-was-run"


@pytest.fixture
def scene(tmp_path: Path, marker: Path) -> Path:
    """A ball, with a script that runs on load, and a driver that moves it by 5."""
    surface = sphere()
    surface.name = "Ball"
    text = bpy.data.texts.new("on_load.py")
    text.write(f"open({str(marker)!r}, 'a').write('text ')")
    text.use_module = True
    driver = surface.driver_add("location", 0).driver
    # Too much for Blender's own reader of plain sums.
    driver.expression = "[5.0, bpy.app.version[0]][0]"
    path = saved(tmp_path / "scene.blend")
    assert not marker.exists()
    return path


@pytest.fixture
def trusting() -> None:
    """A user whose preferences let every file run its scripts."""
    preferences = bpy.context.preferences.filepaths
    before = preferences.use_scripts_auto_execute
    preferences.use_scripts_auto_execute = True
    yield
    preferences.use_scripts_auto_execute = before


def fill(scene: Path, *options: object) -> tuple[int, dict]:
    report = scene.with_name("report.json")
    given = ["--input", scene, "--object", "Ball", "--spacing", 0.5, "--iterations", 2, "--quiet"]
    given += ["--output", scene.with_name("curve.obj"), "--report", report, *options]
    code = batch.main([str(item) for item in given])
    return code, json.loads(report.read_text())


def first_x(scene: Path) -> float:
    """Where the curve of fill() begins."""
    return float(scene.with_name("curve.obj").read_text().split("\nv ", 1)[1].split()[0])


def test_no_python_of_a_scene_is_run(
    scene: Path, marker: Path, trusting: None, capsys: pytest.CaptureFixture
) -> None:
    code, figures = fill(scene)
    assert code == 0
    assert not marker.exists()
    assert abs(first_x(scene)) <= 1.0
    (warning,) = figures["warnings"]
    assert "--run-scripts" in warning and str(scene) in warning
    assert warning in capsys.readouterr().err
    assert figures["options"]["run_scripts"] is False


def test_python_of_a_scene_is_run_where_that_is_asked_for(scene: Path, marker: Path) -> None:
    # It also shows that the scene would do what the other tests say it does not.
    code, figures = fill(scene, "--run-scripts")
    assert code == 0
    assert marker.read_text() == "text "
    assert figures["warnings"] == [] and figures["options"]["run_scripts"] is True
    assert 4.0 <= first_x(scene) <= 6.0


def test_nor_while_the_objects_of_a_job_are_listed(
    scene: Path, marker: Path, tmp_path: Path
) -> None:
    if bpy.app.binary_path:
        # Later arguments win: as with preferences that let scripts run.
        blender = [bpy.app.binary_path, "--background", "--factory-startup", "--enable-autoexec"]
    else:
        start = tmp_path / "start.py"
        start.write_text(
            "import bpy, os, runpy, sys\n"
            "bpy.context.preferences.filepaths.use_scripts_auto_execute = True\n"
            "runpy.run_path(sys.argv[sys.argv.index('--python') + 1], run_name='__main__')\n"
            "os._exit(0)\n"  # as a module, Blender may hang when Python ends
        )
        blender = [sys.executable, str(start)]
    assert Meshes(blender, None).of(scene) == ["Ball"]
    assert not marker.exists()


# ------------------------------------------------------------------------------------------------
# A .blend is written whole or not at all


@pytest.fixture
def short_files() -> None:
    """Every file that grows beyond some length fails, as on a full disk."""
    resource = pytest.importorskip("resource", reason="of POSIX systems")
    heard = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, hard))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    signal.signal(signal.SIGXFSZ, heard)


@pytest.mark.parametrize("compress", [False, True])
def test_a_scene_that_is_cut_off_is_known(tmp_path: Path, compress: bool) -> None:
    scene, part = tmp_path / "scene.blend", tmp_path / "part.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(scene), copy=True, compress=compress)
    assert is_whole(scene)
    data = scene.read_bytes()
    for length in (0, 17, 20_000, len(data) // 2, len(data) - 50):
        part.write_bytes(data[:length])
        assert not is_whole(part), length


@pytest.mark.parametrize("option", ["--output", "--cut"])
def test_a_scene_that_does_not_fit_on_the_disk(
    tmp_path: Path, short_files: None, capfd: pytest.CaptureFixture, option: str
) -> None:
    square = tmp_path / "square.obj"
    square.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
    output = tmp_path / "out.blend"
    output.write_text("earlier")
    given = {"--output": tmp_path / "curve.obj"} | {option: output}
    arguments = ["--input", square, "--spacing", 0.3, "--iterations", 2, "--quiet"]
    arguments += [item for pair in given.items() for item in pair]
    assert batch.main([str(item) for item in arguments]) == 2
    sentences = [line for line in capfd.readouterr().err.splitlines() if "meander: " in line]
    assert len(sentences) == 1 and str(output) in sentences[0]
    assert output.read_text() == "earlier"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.blend", "square.obj"]


# Saves over and over, and says so when it has once.
SAVER = """
import sys
sys.path.insert(0, {addon!r})
import bpy
from pathlib import Path
from meander.headless import scene_output
from meander.model.files.whole import whole_file
bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
while True:
    with whole_file(Path({path!r})) as temporary:
        scene_output._save(temporary, Path({path!r}))
    print("saving", flush=True)
"""


def begun(script: Path) -> subprocess.Popen:
    """A Blender of its own that runs a script, once the script says that it is saving."""
    if bpy.app.binary_path:
        command = [bpy.app.binary_path, "--background", "--factory-startup", "--python"]
    else:
        command = [sys.executable]
    process = subprocess.Popen([*command, str(script)], stdout=subprocess.PIPE, text=True)
    for line in process.stdout:
        if line.startswith("saving"):
            return process
    pytest.fail("the writer has not begun")


def test_a_scene_survives_a_writer_that_is_killed(tmp_path: Path) -> None:
    path, script = tmp_path / "out.blend", tmp_path / "saver.py"
    script.write_text(SAVER.format(addon=str(ADDON), path=str(path)))
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    with begun(script) as saver:
        time.sleep(0.1)
        saver.kill()
        assert saver.wait() == -signal.SIGKILL
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False)
    assert [thing.type for thing in bpy.data.objects] == ["MESH"]  # a saver's, and whole
    left = [each.name for each in tmp_path.iterdir() if each not in (path, script)]
    assert all(name.startswith(".") and ".tmp.blend" in name for name in left), left


# Runs the batch command over and over, until it fails, and says so when it has once.
COMMANDER = """
import os, sys
sys.path.insert(0, {addon!r})
from meander import batch
assert batch.main({given!r}) == 0
print("saving", flush=True)
os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # nobody reads what Blender says of each file
while batch.main({given!r}) == 0:
    pass
sys.exit(3)
"""


def held(path: Path) -> tuple:
    """What a scene of the batch command holds: every point of its curve, its spacing, its mesh."""
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False)
    (mesh,) = (thing for thing in bpy.data.objects if thing.type == "MESH")
    (curve,) = (thing for thing in bpy.data.objects if thing.type == "CURVE")
    points = tuple(tuple(p.co) for spline in curve.data.splines for p in spline.points)
    assert len(points) > 10 and len(mesh.data.polygons) == 512
    return points, curve.meander.spacing, tuple(tuple(v.co) for v in mesh.data.vertices)


def test_two_commands_that_write_one_scene_leave_one_of_both(tmp_path: Path) -> None:
    rows, vertices, faces = 16, [], []
    for i in range(rows + 1):
        vertices += [f"v {i} {j} 0" for j in range(rows + 1)]
    for i in range(rows):
        for a in (i * (rows + 1) + j + 1 for j in range(rows)):
            b = a + rows + 1
            faces += [f"f {a} {b} {b + 1}", f"f {a} {b + 1} {a + 1}"]
    square, folder = tmp_path / "square.obj", tmp_path / "out"
    square.write_text("\n".join(vertices + faces))
    folder.mkdir()
    target, script, versions = folder / "out.blend", tmp_path / "commander.py", set()
    for spacing in ("4.0", "2.0"):
        given = ["--input", str(square), "--spacing", spacing, "--iterations", "2"]
        given += ["--quiet", "--output", str(target)]
        assert batch.main(given) == 0
        versions.add(held(target))
        if not script.exists():
            script.write_text(COMMANDER.format(addon=str(ADDON), given=given))
    assert len(versions) == 2
    seen, looks, ending = set(), 0, time.monotonic() + 30.0
    with begun(script) as other:
        try:
            while looks < 6 or len(seen) < 2 and time.monotonic() < ending:
                assert batch.main(given) == 0
                time.sleep(random.uniform(0.0, 0.3))  # or only one's own is seen
                seen.add(held(target))
                looks += 1
                assert seen <= versions and other.poll() is None, "a writer has failed"
        finally:
            other.kill()
            other.communicate()
    assert len(seen) == 2, "only one of both was seen to write"
    assert held(target) in versions
    left = [each.name for each in folder.iterdir() if each != target]
    assert all(name.startswith(".") and ".tmp.blend" in name for name in left), left
