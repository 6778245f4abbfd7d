# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command as the engine: in Python, and in Blender on the objects of a scene."""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import geometry
import pytest
from conftest import FARM
from meander.model.files import obj
from test_running import sentence_of, until

SCENE = """
import bpy, sys
bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
for name, place in (("Rock 1", 0), ("Tree", 9)):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2, location=(place, 0, 0))
    bpy.context.object.name = name
rock = bpy.data.objects["Rock 1"]
for frame, size in ((1, 1.0), (10, 2.0)):
    rock.scale = (size, size, size)
    rock.keyframe_insert("scale", frame=frame)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
"""


@pytest.fixture
def blender() -> str:
    found = shutil.which("blender")
    assert found, "these tests need Debian's Blender"
    return found


def test_meshes_with_one_that_is_malformed(job):
    good = geometry.obj_text(geometry.grid(6))
    job.meshes(a=good, b=good, bad="v 0 0\n", c=good)
    job.write('[defaults]\nspacing = 0.15\n[[items]]\ninput = "meshes/*.obj"\n', fake=False)
    done = job.run("--jobs", "2")
    assert done.returncode == 1
    assert "3 of 4 items done, 1 failed" in done.stderr
    assert "is not a vertex with three coordinates" in sentence_of(job, "bad")
    curves = [(job.results / f"{name}.obj").read_bytes() for name in "abc"]
    assert len(set(curves)) == 1 and len(curves[0]) > 1000
    report = json.loads((job.results / "a.report.json").read_text())
    assert report["stop_reason"] == "converged" and report["crossings"] == 0
    curve = obj.read_obj_curve(job.results / "a.obj")
    assert geometry.off_surface(geometry.grid(6), curve.points).max() < 1e-9


def test_an_item_that_would_be_too_large_is_a_failed_item(job):
    job.meshes(a=geometry.obj_text(geometry.grid(6)))
    text = '[defaults]\nspacing = 0.1\niterations = 3\n%s\n[[items]]\ninput = "meshes/*.obj"\n'
    job.write(text % "limit-nodes = 10", fake=False)
    assert job.run().returncode == 1
    assert "raise --limit-nodes" in sentence_of(job, "a")
    job.write(text % "", fake=False)
    assert job.run().returncode == 0
    # What may be has nothing to do with what was made.
    job.write(text % "limit-nodes = 100_000", fake=False)
    assert "1 of 1 item done" in job.run("--status").stderr


def test_an_item_with_gaps_fails_where_that_is_asked_for(job):
    job.meshes(a=geometry.obj_text(geometry.grid(6)))
    text = (
        '[defaults]\nspacing = 0.1\niterations = %d\nfail-on-gaps = true\n'
        '[[items]]\ninput = "meshes/*.obj"\n'
    )
    job.write(text % 3, fake=False)
    assert job.run().returncode == 1
    said = sentence_of(job, "a")
    assert "of the surface is empty" in said and "raise --iterations" in said
    # What was made is there, and says the same; the item is tried again all the same.
    report = json.loads((job.results / "a.report.json").read_text())
    assert report["empty"]["share"] > 0.5 and (job.results / "a.obj").stat().st_size > 0
    assert "0 of 1 item" in job.run("--status").stderr
    job.write(text % 2000, fake=False)
    assert job.run().returncode == 0
    report = json.loads((job.results / "a.report.json").read_text())
    assert report["empty"]["share"] < 0.001


def test_a_limit_of_memory_is_a_failed_item(job):
    job.meshes(a=geometry.obj_text(geometry.grid(6)), b=geometry.obj_text(geometry.grid(300)))
    job.write(
        "[defaults]\nspacing = 0.15\nthreads = 1\nmemory = 100\n"
        'iterations = 3\n[[items]]\ninput = "meshes/*.obj"\n',
        fake=False,
    )
    assert job.run().returncode == 1
    assert sentence_of(job, "b") == "needs more than 100 MB; raise memory, or the spacing"
    assert (job.results / "a.obj").exists() and not (job.results / "b.obj").exists()


def test_a_run_that_is_interrupted_leaves_nothing_half(job):
    job.meshes(a=geometry.obj_text(geometry.grid(30)))
    job.write('[[items]]\ninput = "meshes/a.obj"\nspacing = 0.004\n', fake=False)
    process = job.start()
    log = job.results / "a.log.part"
    until(lambda: log.exists())
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=20) == 130
    left = sorted(path.name for path in job.results.iterdir() if path.is_file())
    assert left == ["a.log", "summary.json"]


def test_objects_and_frames_of_a_scene(job, blender):
    scene = job.folder / "scene.blend"
    maker = job.folder / "scene.py"
    maker.write_text(SCENE)
    start = [blender, "--background", "--factory-startup", "--python-exit-code", "1"]
    subprocess.run(
        [*start, "--python", str(maker), "--", str(scene)], check=True, capture_output=True
    )
    job.write(
        '[defaults]\nspacing = 0.5\nmemory = 3000\n'
        '[[items]]\ninput = "*.blend"\nobject = "Rock*"\nframes = "1,10"\n'
        'name = "{object}-{frame:02}"\niterations = 60\noutput = "{name}.csv"\n',
        fake=False,
    )
    # The command itself runs in Blender as well, whose Python is all that a farm may have.
    command = [*start, "--python", str(FARM), "--", str(job.file), "--jobs", "2"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    areas = []
    for name in ("Rock_1-01", "Rock_1-10"):
        report = json.loads((job.results / f"{name}.report.json").read_text())
        areas.append(report["surface"]["area"])
        assert report["options"]["object"] == "Rock 1"
        assert report["options"]["frame"] == int(name[-2:])
        assert (job.results / f"{name}.csv").stat().st_size > 1000
    assert areas[1] == pytest.approx(4 * areas[0], rel=1e-5)
    # What a file holds is asked once.
    assert len(list((job.results / "state" / "objects").iterdir())) == 1
    assert job.run("--list").stdout.count("done") == 2


def test_a_python_without_numpy_says_so(job):
    job.meshes(a="ok")
    job.fill_all()
    done = subprocess.run(
        [sys.executable, "-S", str(FARM), str(job.file)], capture_output=True, text=True,
        env={"PATH": "/usr/bin:/bin"},
    )  # fmt: skip
    assert done.returncode == 2
    assert done.stderr.startswith("meander: this Python has no numpy")
    assert not job.results.exists()


def test_the_package_is_started_by_its_script_alone():
    done = subprocess.run([sys.executable, str(FARM), "--help"], capture_output=True, text=True)
    assert done.returncode == 0
    assert "--shard" in done.stdout and Path(FARM).name in done.stdout
