# SPDX-License-Identifier: GPL-3.0-or-later
"""`blender --command meander` in a whole Blender, from 4.2 on, that the zip is installed in.

Debian 12's is older, and bpy modules ignore --command; so scripts/test_debian13.sh runs this.

MEANDER_ZIP   the zip
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

SCENE = """
import bpy, sys
bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
for name, place in (("Ball", 0), ("Rock", 9)):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, location=(place, 0, 0))
    bpy.context.object.name = name
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
"""
JOB = """
[job]
engine = "blender"
[defaults]
spacing = 0.4
memory = 4000
[[items]]
input = "scene.blend"
object = "*"
[[items]]
input = "ball.obj"
"""


class Blender:
    """A Blender with the add-on in a profile of its own, and a folder to work in."""

    def __init__(self, folder: Path) -> None:
        self.work, self.profile = folder / "work", folder / "profile"
        for place in (self.work, self.profile):
            place.mkdir()
        program = shutil.which("blender")
        assert program, "there is no blender on the PATH"
        self.program = program
        self.environment = {
            "PATH": os.environ["PATH"], "LANG": "C.UTF-8", "HOME": str(folder),
            "BLENDER_USER_RESOURCES": str(self.profile),
        }  # fmt: skip

    def run(self, *arguments: object) -> subprocess.CompletedProcess:
        return subprocess.run(
            [self.program, *map(str, arguments)], cwd=self.work, env=self.environment,
            capture_output=True, text=True, timeout=120,
        )  # fmt: skip

    def fill(self, *arguments: object) -> subprocess.CompletedProcess:
        return self.run("--command", "meander", *arguments)

    @property
    def installed(self) -> Path:
        (found,) = self.profile.glob("extensions/user_default/meander")
        return found


@pytest.fixture(scope="module")
def blender(tmp_path_factory: pytest.TempPathFactory) -> Blender:
    """With the zip installed by Blender's own command for extensions."""
    made = Blender(tmp_path_factory.mktemp("blender"))
    done = made.run(
        "--command", "extension", "install-file", "--repo", "user_default", "--enable",
        os.environ["MEANDER_ZIP"],
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    script = made.work / "scene.py"
    script.write_text(SCENE)
    scene = made.work / "scene.blend"
    made.run("--background", "--factory-startup", "--python", script, "--", scene)
    assert scene.exists()
    corners = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(1, 3, 5), (3, 2, 5), (2, 4, 5), (4, 1, 5), (3, 1, 6), (2, 3, 6), (4, 2, 6), (1, 4, 6)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {a} {b} {c}" for a, b, c in faces]
    (made.work / "ball.obj").write_text("\n".join(lines) + "\n")
    return made


def test_blender_lists_it_and_knows_its_version(blender: Blender) -> None:
    assert "meander" in blender.run("--command", "help").stdout.split()
    done = blender.fill("--version")
    assert done.returncode == 0
    assert done.stdout.splitlines()[-1].startswith("Meander ")


def test_it_writes_the_bytes_of_the_batch_command(blender: Blender) -> None:
    given = ["--input", "scene.blend", "--object", "Rock", "--spacing", "0.3", "--direction", "z"]
    done = blender.fill(*given, "--output", "command.obj", "--report", "report.json")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "wrote command.obj" in done.stdout
    report = json.loads((blender.work / "report.json").read_text())
    assert report["crossings"] == 0 and report["options"]["object"] == "Rock"
    done = blender.run(
        "--background", "--factory-startup", "--python-exit-code", "1", "--python",
        blender.installed / "batch.py", "--", *given, "--output", "batch.obj",
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    written = (blender.work / "command.obj").read_bytes()
    assert len(written) > 1000
    assert written == (blender.work / "batch.obj").read_bytes()


def test_it_writes_a_scene(blender: Blender) -> None:
    given = ["--input", "scene.blend", "--object", "Ball", "--spacing", "0.4"]
    done = blender.fill(*given, "--output", "filled.blend")
    assert done.returncode == 0, done.stdout + done.stderr
    told = blender.run(
        "--background", "--factory-startup", blender.work / "filled.blend", "--python-expr",
        "import bpy; print('holds', sorted(ob.name for ob in bpy.data.objects))",
    )
    assert "holds ['Ball', 'Ball Meander', 'Rock']" in told.stdout


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        (("--spacing", "-1"), "--spacing"),
        (("--spacing", "0.3", "--object", "Nobody"), "no object 'Nobody'"),
        (("--spacing", "0.3", "--input", "gone.blend"), "gone.blend does not exist"),
        ((), "--spacing"),
    ],
)
def test_bad_input_is_one_sentence(blender: Blender, extra: tuple, words: str) -> None:
    kept = blender.work / "kept.obj"
    kept.write_text("earlier")
    done = blender.fill("--input", "scene.blend", "--output", kept, *extra)
    assert done.returncode == 2
    (sentence,) = (line for line in done.stderr.splitlines() if line.startswith("meander: "))
    assert words in sentence
    assert kept.read_text() == "earlier"


def test_an_interruption_leaves_nothing_half(blender: Blender) -> None:
    before = sorted(blender.work.iterdir())
    given = ["--input", "scene.blend", "--object", "Ball", "--spacing", "0.004"]
    process = subprocess.Popen(
        [blender.program, "--command", "meander", *given, "--output", "long.obj"],
        cwd=blender.work, env=blender.environment, stdout=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )  # fmt: skip
    assert process.stdout is not None
    while "after" not in process.stdout.readline():  # it grows
        time.sleep(0.01)
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130
    assert sorted(blender.work.iterdir()) == before


def test_a_job_in_the_python_of_blender_alone(blender: Blender) -> None:
    """farm.py and its items, all of them in Blender."""
    (blender.work / "fill.toml").write_text(JOB)
    command = [
        "--background", "--factory-startup", "--python-exit-code", "1", "--python",
        blender.installed / "farm.py", "--", "fill.toml",
    ]  # fmt: skip
    done = blender.run(*command)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "3 of 3 items done, 0 failed, 0 left" in done.stderr
    written = {path.name for path in (blender.work / "fill").glob("*.obj")}
    assert written == {"scene-Ball.obj", "scene-Rock.obj", "ball.obj"}
    again = blender.run(*command, "--list")
    assert again.returncode == 0
    assert again.stdout.count("done  ") == 3
