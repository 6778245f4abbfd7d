# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip installed into an empty profile, outside of the checkout, and used from there."""

import json
import os
import shutil
import subprocess
import zipfile
from pathlib import Path

import geometry
import pytest

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent


class Blender:
    """A Blender with a profile of its own; every call is a new process."""

    def __init__(self, kind: str, program: str, folder: Path) -> None:
        self.kind = kind
        self.program = program
        self.folder = folder
        self.profile = folder / "profile"
        # Only what a process needs: neither a PYTHONPATH nor a variable of ours may help.
        self.environment = {
            "PATH": os.environ["PATH"],
            "HOME": str(folder / "home"),
            "LANG": "C.UTF-8",
            "BLENDER_USER_CONFIG": str(self.profile / "config"),
            "BLENDER_USER_SCRIPTS": str(self.profile / "scripts"),
            "BLENDER_USER_DATAFILES": str(self.profile / "datafiles"),
            "BLENDER_USER_RESOURCES": str(self.profile),
        }
        for name in ("home", "work", "profile/config", "profile/scripts", "profile/datafiles"):
            (folder / name).mkdir(parents=True)

    def run(self, script: Path, *arguments: object) -> subprocess.CompletedProcess:
        if self.kind == "bpy":
            command = [self.program, script]
        else:
            command = [self.program, "--background", "--python-exit-code", "1", "--python", script]
        return subprocess.run(
            [*command, "--", *arguments],
            cwd=self.folder / "work", env=self.environment,
            capture_output=True, text=True, timeout=240,
        )


@pytest.fixture(scope="module", params=["blender-3.4", "bpy"])
def installed(
    request: pytest.FixtureRequest,
    addon_zip: Path,
    bpy_python: Path,
    tmp_path_factory: pytest.TempPathFactory,
) -> tuple[Blender, Path]:
    """A Blender with the add-on installed, and the folder that it was installed into."""
    folder = tmp_path_factory.mktemp(request.param)
    if request.param == "bpy":
        blender = Blender("bpy", str(bpy_python), folder)
    else:
        blender = Blender("blender", shutil.which("blender"), folder)
    # A copy that is removed afterwards: nothing may lean on the zip or on what lies beside it.
    copy = folder / "work" / addon_zip.name
    shutil.copy(addon_zip, copy)
    done = blender.run(ROOT / "scripts/install_addon.py", copy)
    copy.unlink()
    assert done.returncode == 0, done.stdout + done.stderr
    inside = [line for line in done.stdout.splitlines() if line.startswith(str(blender.profile))]
    assert inside, f"not installed into the profile:\n{done.stdout}{done.stderr}"
    return blender, Path(inside[-1])


def test_fills_with_the_operator(installed: tuple[Blender, Path]) -> None:
    blender, addon = installed
    report = blender.folder / "work/found.json"
    done = blender.run(HERE / "fill_with_operator.py", report)
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads(report.read_text())

    assert Path(found["addon"]) == addon
    # The library comes from the profile: nothing of the checkout was used.
    assert [Path(path).parent for path in found["libraries"]] == [addon / "native" / "linux-x64"]
    # Embroidery works without anything else, by the wheel that the zip brings.
    assert found["stitches"] > 1000
    if blender.kind == "blender":
        assert Path(found["embroidery"]).is_relative_to(addon / "wheels")
    else:
        extensions = blender.profile / "extensions"
        assert list(extensions.rglob("site-packages/pyembroidery/__init__.py"))
    assert found["limits"] == [500_001, 500_001], "the preferences are not those of the add-on"
    assert found["cyclic"] == [True]
    assert found["length"] > 4 * found["seed_length"], "the curve has hardly grown"
    # Splines are stored in single precision, and chords of a face leave no more than that.
    assert found["farthest_from_surface"] < 1e-5
    # A curve of this length and spacing covers the surface; the borders are those of the
    # default settings' packing, wide enough for a sphere of a few strands.
    assert 0.8 < found["length"] * found["spacing"] / found["area"] < 1.2


def test_batch_command_of_the_installed_addon(installed: tuple[Blender, Path]) -> None:
    blender, addon = installed
    work = blender.folder / "work"
    geometry.write_obj(work / "octahedron.obj", geometry.octahedron())
    done = blender.run(
        addon / "batch.py",
        "--input", work / "octahedron.obj", "--output", work / "curve.obj",
        "--report", work / "curve.json", "--spacing", "0.2",
    )
    assert done.returncode == 0, done.stdout + done.stderr
    report = json.loads((work / "curve.json").read_text())
    assert report["crossings"] == 0
    assert report["surface"]["components"] == 1
    assert any(line.startswith("l ") for line in (work / "curve.obj").read_text().splitlines())


def test_batch_command_refuses_bad_input(installed: tuple[Blender, Path]) -> None:
    blender, addon = installed
    work = blender.folder / "work"
    done = blender.run(
        addon / "batch.py",
        "--input", work / "missing.obj", "--output", work / "never.obj", "--spacing", "0.2",
    )
    assert done.returncode == 2, done.stdout + done.stderr
    assert "missing.obj" in done.stderr
    assert not (work / "never.obj").exists()


def test_an_upgrade_in_one_session_leaves_nothing_of_the_old_version(
    installed: tuple[Blender, Path], addon_zip: Path
) -> None:
    blender, _addon = installed
    work = blender.folder / "work"
    with zipfile.ZipFile(addon_zip) as old, zipfile.ZipFile(work / "new.zip", "w") as new:
        for entry in old.infolist():
            text = old.read(entry)
            if entry.filename.endswith(".py"):
                text += b"\nNEW_VERSION = True\n"
            new.writestr(entry, text)
    done = blender.run(
        HERE / "upgrade_in_place.py", addon_zip, work / "new.zip", work / "upgraded.json"
    )
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads((work / "upgraded.json").read_text())
    assert found["result"].startswith("Cube")
    assert any(name.endswith("meander.core") for name in found["modules"])
    assert found["old"] == []
