# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package: its wheel, and what it does where there is numpy and no Blender."""

from __future__ import annotations

import base64
import csv
import doctest
import hashlib
import io
import json
import os
import shutil
import signal
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from email.parser import Parser
from pathlib import Path

import geometry
import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "build_wheel.py"
PAGE = ROOT / "docs" / "python.md"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run([sys.executable, SCRIPT, "--folder", folder], check=True, timeout=60)
    (found,) = folder.iterdir()
    return found


class Environment:
    """A virtual environment with the wheel, and a folder far from the checkout."""

    def __init__(self, folder: Path) -> None:
        self.python = folder / "environment" / "bin" / "python"
        self.command = self.python.with_name("meander")
        self.work = folder / "work"
        self.work.mkdir()
        # Only what a process needs: neither a PYTHONPATH nor a variable of ours may help.
        self.environment = {"PATH": os.environ["PATH"], "HOME": str(folder), "LANG": "C.UTF-8"}

    def run(self, *command: object) -> subprocess.CompletedProcess:
        return subprocess.run(
            [str(word) for word in command], cwd=self.work, env=self.environment,
            capture_output=True, text=True, timeout=120,
        )  # fmt: skip


@pytest.fixture(scope="module")
def installed(
    wheel: Path, bpy_python: Path, tmp_path_factory: pytest.TempPathFactory
) -> Environment:
    folder = tmp_path_factory.mktemp("installed")
    environment = Environment(folder)
    # The system's Python has numpy, so nothing is fetched; a pip of its own would take 10 s.
    options = ["--system-site-packages", "--without-pip"]
    place = folder / "environment"
    made = environment.run("/usr/bin/python3", "-m", "venv", *options, place)
    assert made.returncode == 0, made.stdout + made.stderr
    done = environment.run(
        bpy_python, "-m", "pip", "--python", environment.python, "install", "--no-index", wheel
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return environment


@pytest.fixture
def ball(installed: Environment) -> Path:
    return geometry.write_obj(installed.work / "ball.obj", geometry.octahedron())


def test_a_library_that_is_cut_off_is_one_sentence_for_who_has_a_wheel(
    installed: Environment
) -> None:
    path = installed.run(
        installed.python, "-c", "import meander.core as core; print(core.library_path())"
    ).stdout.strip()
    whole = Path(path).read_bytes()
    try:
        for size in (5000, 100_000, len(whole) - 1):
            Path(path).write_bytes(whole[:size])
            done = installed.run(
                installed.python, "-c", "import meander; meander.default_options()"
            )
            said = done.stderr.splitlines()[-1]
            assert done.returncode == 1
            assert f"cut off (it has {size} of {len(whole)} bytes)" in said
            assert "wheel" in said and "Blender" not in said and "add-on" not in said
    finally:
        Path(path).write_bytes(whole)


# ------------------------------------------------------------------------------------------------
# The file


def test_it_is_a_wheel_of_one_platform_for_every_python(wheel: Path) -> None:
    name, version, python, abi, _platform = wheel.stem.split("-")
    with zipfile.ZipFile(wheel) as archive:
        assert archive.testzip() is None
        about = Parser().parsestr(archive.read(f"meander-{version}.dist-info/METADATA").decode())
        tags = Parser().parsestr(archive.read(f"meander-{version}.dist-info/WHEEL").decode())
        names = archive.namelist()
        record = archive.read(f"meander-{version}.dist-info/RECORD").decode()
        noted = {path: (digest, size) for path, digest, size in csv.reader(io.StringIO(record))}
        assert noted.keys() == set(names)
        for path, (digest, size) in noted.items():
            if digest:
                data = archive.read(path)
                wanted = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=")
                assert (digest, size) == (f"sha256={wanted.decode()}", str(len(data))), path
    assert (name, python, abi) == ("meander", "py3", "none")
    assert tags["Tag"] == wheel.stem.removeprefix(f"meander-{version}-")
    assert tags["Root-Is-Purelib"] == "false"
    assert (about["Name"], about["Version"]) == ("meander", version)
    required = [text for text in about.get_all("Requires-Dist") if "extra" not in text]
    assert required == ["numpy>=1.23"]
    library, beside = sorted(path for path in names if path.startswith("meander/native/"))
    assert beside == f"{library}.record"
    with zipfile.ZipFile(wheel) as archive:
        data = archive.read(library)
        assert archive.read(beside).decode() == f"{len(data)} {hashlib.sha256(data).hexdigest()}\n"
        assert archive.getinfo(library).external_attr >> 16 == 0o755
    assert {"meander/py.typed", "meander/core.py", "meander/binding/abi.py"} <= set(names)
    for text in ("LICENSE", "THIRD_PARTY_NOTICES.md"):
        assert f"meander-{version}.dist-info/licenses/{text}" in names


def test_its_modules_are_those_of_the_addon(wheel: Path) -> None:
    own = {path.name for path in (ROOT / "python/meander").iterdir() if path.is_file()}
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            inside = name.removeprefix("meander/")
            if name.startswith("meander/") and not inside.startswith("native/"):
                source = ROOT / ("python" if inside in own else "addon") / name
                assert archive.read(name) == source.read_bytes()
                first = inside.split("/")[0]
                assert first not in ("scene", "run", "ui", "headless", "batch.py", "farm.py")


def test_the_same_contents_give_the_same_bytes(wheel: Path, tmp_path: Path) -> None:
    checkout = tmp_path / "elsewhere"
    for name in ("addon/meander", "python", "scripts"):
        shutil.copytree(ROOT / name, checkout / name)
    for name in ("pyproject.toml", "LICENSE", "THIRD_PARTY_NOTICES.md", "docs/python.md"):
        (checkout / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, checkout / name)
    (checkout / "addon/meander/model/__pycache__").mkdir(exist_ok=True)
    (checkout / "addon/meander/model/__pycache__/left.pyc").write_bytes(b"behind")
    subprocess.run(
        [sys.executable, checkout / "scripts/build_wheel.py", "--folder", tmp_path],
        check=True, timeout=60,
    )  # fmt: skip
    assert (tmp_path / wheel.name).read_bytes() == wheel.read_bytes()


def test_a_library_and_a_platform_can_be_named(wheel: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        inside = min(name for name in names if name.startswith("meander/native/"))
        library = Path(archive.extract(inside, tmp_path / "taken"))
    command = [sys.executable, SCRIPT, "--folder", tmp_path, "--library", library]
    alone = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert alone.returncode == 2 and "--platform" in alone.stderr
    subprocess.run([*command, "--platform", "manylinux_2_28_x86_64"], check=True, timeout=60)
    (made,) = tmp_path.glob("*.whl")
    assert made.name.endswith("-py3-none-manylinux_2_28_x86_64.whl")
    with zipfile.ZipFile(made) as archive:
        assert archive.read(inside) == library.read_bytes()


def test_the_packed_sources_are_all_that_a_build_needs(
    wheel: Path, bpy_python: Path, tmp_path: Path
) -> None:
    """What pip gets, which scripts/test_source_package.sh also compiles: the modules of the wheel,
    in the places that pyproject.toml names, and sources from which CMake can make the rest."""
    pack = f"import scikit_build_core.build as builder; builder.build_sdist({str(tmp_path)!r})"
    subprocess.run([bpy_python, "-c", pack], cwd=ROOT, check=True, timeout=60)
    (packed,) = tmp_path.glob("meander-*.tar.gz")
    with tarfile.open(packed) as archive:
        archive.extractall(tmp_path)
    sources = tmp_path / packed.name.removesuffix(".tar.gz")

    settings = tomllib.loads((sources / "pyproject.toml").read_text())["tool"]["scikit-build"]
    modules = {
        f"{place}/{path.relative_to(sources / folder).as_posix()}"
        for place, folder in settings["wheel"]["packages"].items()
        for path in (sources / folder).rglob("*")
        if path.is_file()
    }
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
    made = {name for name in names if name.startswith("meander/native/")}
    assert modules == names - made - {"meander/core.py", "meander/binding/abi.py"}

    build = tmp_path / "build"
    options = [
        f"-D{name}={'ON' if value else 'OFF'}"
        for name, value in (settings["cmake"]["define"] | {"SKBUILD": True}).items()
    ]
    for command in (
        ["cmake", "-S", sources, "-B", build, "-G", "Ninja", *options],
        ["ninja", "-C", build, "-n", *settings["build"]["targets"]],
        ["ninja", "-C", build, "abi"],
    ):
        done = subprocess.run(command, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stdout + done.stderr
    with zipfile.ZipFile(wheel) as archive:
        module = archive.read("meander/binding/abi.py")
    assert (sources / "addon/meander/binding/abi.py").read_bytes() == module
    installed = (build / "cmake_install.cmake").read_text()
    for name in ("core.py", "abi.py", "libmeander"):
        assert name in installed


# ------------------------------------------------------------------------------------------------
# The package


def test_the_page_about_it_is_right(installed: Environment) -> None:
    """The examples of docs/python.md, by doctest."""
    (installed.work / "build/example").mkdir(parents=True)
    shutil.copy(PAGE, installed.work / "page.md")
    examples = len(doctest.DocTestParser().get_examples(PAGE.read_text(encoding="utf-8")))
    assert examples > 15
    done = installed.run(installed.python, "-m", "doctest", "-v", "page.md")
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"{examples} passed and 0 failed" in done.stdout
    written = {path.name for path in (installed.work / "build/example").iterdir()}
    drawn = {f"octahedron{suffix}" for suffix in (".obj", ".csv", ".svg")}
    assert written == drawn | {"ramp.svg"}


def test_the_example_that_help_shows_is_right(installed: Environment, ball: Path) -> None:
    shutil.copy(ball, installed.work / "spot.obj")
    script = (
        "import inspect, meander\n"
        "paragraphs = inspect.cleandoc(meander.__doc__).split('\\n\\n')\n"
        "(first, *rest) = [text for text in paragraphs if text.startswith('    ')]\n"
        "example = inspect.cleandoc('\\n' + '\\n'.join([first, *rest]))\n"
        "assert example.startswith('import meander') and 'write_curve' in example\n"
        "exec(example)\n"
        "print(reason)\n"
    )
    done = installed.run(installed.python, "-c", script)
    assert (done.returncode, done.stdout) == (0, "converged\n"), done.stderr
    assert (installed.work / "spot.svg").read_text().startswith("<?xml")


def test_it_needs_nothing_but_numpy(installed: Environment) -> None:
    script = (
        "import sys, numpy\n"
        "before = set(sys.modules)\n"
        "import meander, meander.__main__\n"
        "tops = {name.partition('.')[0] for name in set(sys.modules) - before}\n"
        "print(*tops - sys.stdlib_module_names)\n"
        "print(meander.library_path())\n"
    )
    done = installed.run(installed.python, "-c", script)
    assert done.returncode == 0, done.stderr
    tops, library = done.stdout.splitlines()
    assert set(tops.split()) <= {"meander", "numpy"}
    assert Path(library).is_relative_to(installed.python.parents[1])


def test_every_name_is_there_and_says_what_it_is(installed: Environment) -> None:
    script = (
        "import inspect, typing\n"
        "import meander\n"
        "names = meander.__all__\n"
        "assert len(names) == len(set(names)) and names == sorted(names, key=lambda name:\n"
        "    (not name.isupper(), name.islower() or name[0] == '_', name))\n"
        "for name in names:\n"
        "    item = getattr(meander, name)\n"
        "    if callable(item):\n"
        "        assert item.__doc__, name\n"
        "        assert item.__module__.startswith('meander'), name\n"
        "    if inspect.isfunction(item):\n"
        "        hints = typing.get_type_hints(item)\n"
        "        assert hints.keys() == {*inspect.signature(item).parameters, 'return'}, name\n"
        "from pathlib import Path\n"
        "assert (Path(meander.__file__).parent / 'py.typed').is_file()\n"
    )
    done = installed.run(installed.python, "-c", script)
    assert done.returncode == 0, done.stderr


def test_what_cannot_be_written_is_one_sentence(installed: Environment) -> None:
    script = (
        "import meander\n"
        "vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n"
        "options = meander.default_options('even')\n"
        "options.radius = 0.1\n"
        "with meander.Surface(vertices, [[0, 1, 2]]) as surface:\n"
        "    flow = meander.Flow(surface, options)\n"
        "flow.run()\n"
        "for name, given in (\n"
        "    ('a.step', {}), ('a.obj', {'step': 0.1}), ('a.csv', {'step': 0.1, 'tolerance': 1}),\n"
        "    ('a.csv', {'step': 0}), ('a.csv', {'layout': 'top'}), ('a.svg', {'feed': 1}),\n"
        "    ('a.svg', {'layout': 'uv'}), ('a.svg', {'visible_only': True}),\n"
        "    ('a.svg', {'colour': 1}), ('a.svg', {'scale': -1}), ('a.svg', {'scale': 'big'}),\n"
        "    ('nowhere/a.obj', {}), ('a.gcode', {'arcs': 0.1}), ('a.dxf', {'sheet': (90, 90)}),\n"
        "    ('a.svg', {'sheet': 'a4'}), ('a.svg', {'sheet': (90, 90), 'sheet_margin': 45}),\n"
        "    ('a.svg', {'sheet': (90, 90), 'sheet_margin': 44.9}),\n"
        "    ('a.csv', {'step': 'long'}),\n"
        "    ('a.gcode', {'relative': 'no'}), ('a.gcode', {'layers': 1.5}),\n"
        "    ('a.gcode', {'dip_x': 5}), ('a.svg', {'part_length': 1}),\n"
        "):\n"
        "    try:\n"
        "        meander.write_curve(name, flow, **given)\n"
        "        print('written', name, given)\n"
        "    except meander.FileError as refusal:\n"
        "        assert '\\n' not in str(refusal) and len(str(refusal).split()) > 3, refusal\n"
        "try:\n"
        "    meander.write_curve('a.obj', flow.polylines())\n"
        "except meander.FileError as refusal:\n"
        "    print(refusal)\n"
        "try:\n"
        "    meander.write_cut('a.stl', meander.cut_surface(flow), 0.2)\n"
        "except meander.FileError as refusal:\n"
        "    print(refusal)\n"
        "meander.write_cut('cut.ply', meander.cut_surface(flow), 0.2)\n"
        "print(len(meander.read_mesh('cut.ply')[1]) > 20)\n"
        "meander.write_curve('in.svg', flow, size=300, sheet=(200, 200), sheet_margin=20)\n"
    )
    done = installed.run(installed.python, "-c", script)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        "flow must be a Flow, not a Polylines; write that of one",
        "a.stl is no .obj or .ply file; choose another suffix", "True"
    ]
    sheets = {path.name for path in installed.work.glob("in_*")}
    assert {"in_r1c1.svg", "in_r2c1.svg", "in_r2c2.svg"} <= sheets
    assert not list(installed.work.glob("a*.svg")) and not list(installed.work.glob("a*.dxf"))
    assert not list(installed.work.glob("a.*")) and not list(installed.work.glob(".*.tmp*"))


# ------------------------------------------------------------------------------------------------
# The command


def test_it_gives_the_bytes_of_the_batch_command(
    installed: Environment, ball: Path, bpy_python: Path
) -> None:
    given = ["--input", ball, "--spacing", "0.2", "--direction", "z", "--iterations", "80"]
    for name, command, suffixes in (
        ("module", [installed.python, "-m", "meander"], [".obj"]),
        ("wheel", [installed.command], [".json", ".svg", ".obj"]),
        ("batch", [bpy_python, ROOT / "addon/meander/batch.py", "--"], [".json", ".svg", ".obj"]),
    ):
        for suffix in suffixes:
            output = installed.work / name / f"curve{suffix}"
            output.parent.mkdir(exist_ok=True)
            report = output.with_name("report.json")
            done = installed.run(*command, *given, "--output", output, "--report", report)
            assert done.returncode == 0, done.stderr
            if name == "batch":
                # A ball has two sides, which cross in a drawing; nothing else is said.
                crosses = "warning: the drawing crosses itself" in done.stderr
                assert "wrote" in done.stdout and len(done.stderr.splitlines()) == crosses
                assert crosses == (suffix == ".svg")
            else:
                assert "wrote" in done.stderr and not done.stdout
    reports = {}
    for name in ("wheel", "module", "batch"):
        reports[name] = json.loads((installed.work / name / "report.json").read_text())
        reports[name]["options"].pop("output")
        reports[name].pop("seconds")
        for record in reports[name]["history"]:
            record.pop("seconds")
    assert reports["wheel"] == reports["module"] == reports["batch"]
    for name, suffixes in (("module", [".obj"]), ("wheel", [".json", ".svg", ".obj"])):
        for suffix in suffixes:
            written = (installed.work / name / f"curve{suffix}").read_bytes()
            assert written == (installed.work / "batch" / f"curve{suffix}").read_bytes()


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        (("--spacing", "-1"), "--spacing"),
        (("--spacing", "0.2", "--object", "Ball"), "--object needs Blender"),
        (("--spacing", "0.2", "--input", "scene.blend"), "scene.blend"),
        (("--spacing", "0.2", "--layout", "uv", "--output", "a.svg"), "UV map"),
        (("--spacing", "0.2", "--output", "a.dst"), "pip install pyembroidery, and try again"),
    ],
)
def test_bad_input_is_one_sentence(
    installed: Environment, ball: Path, extra: tuple, words: str
) -> None:
    (installed.work / "scene.blend").write_bytes(b"BLENDER")
    kept = installed.work / "kept.obj"
    kept.write_text("earlier")
    done = installed.run(installed.command, "--input", ball, "--output", kept, *extra)
    assert (done.returncode, done.stdout) == (2, "")
    (sentence,) = done.stderr.splitlines()
    assert sentence.startswith("meander: ") and words in sentence
    assert kept.read_text() == "earlier" and not (installed.work / "a.svg").exists()


def test_a_job_of_many_meshes(installed: Environment, ball: Path) -> None:
    text = '[defaults]\nspacing = 0.3\n[[items]]\ninput = ["ball.obj", "bad.obj"]\n'
    (installed.work / "bad.obj").write_text("v 0 0\n")
    job = installed.work / "job.toml"
    job.write_text(text)
    command = [installed.python, "-m", "meander.jobs", job]
    done = installed.run(*command)
    assert done.returncode == 1
    assert "1 of 2 items done, 1 failed, 0 left" in done.stderr
    assert "three coordinates" in done.stderr
    direct = installed.work / "direct.obj"
    installed.run(installed.command, "--input", ball, "--spacing", "0.3", "--output", direct)
    assert (installed.work / "job" / "ball.obj").read_bytes() == direct.read_bytes()
    script = installed.run(*command, "--slurm", "2").stdout
    assert f"exec {installed.python} -m meander.jobs {job} " in script
    told = installed.run(*command[:-1], "--help").stdout
    assert told.startswith("usage: python -m meander.jobs ") and "farm.py" not in told
    (installed.work / "scene.blend").write_bytes(b"BLENDER")
    for more, words in (("", "Python package"), ('object = "Rock*"\n', "in Blender only")):
        job.write_text(f'[defaults]\nspacing = 0.3\n[[items]]\ninput = "scene.blend"\n{more}')
        done = installed.run(*command)
        assert (done.returncode, done.stdout) == (2, "")
        (sentence,) = done.stderr.splitlines()
        assert words in sentence and "farm.py" in sentence


def test_its_help_names_what_needs_blender(installed: Environment) -> None:
    told = installed.run(installed.command, "--version")
    assert (told.returncode, told.stderr) == (0, "") and told.stdout.startswith("Meander ")
    done = installed.run(installed.command, "--help")
    assert (done.returncode, done.stderr) == (0, "")
    text = " ".join(done.stdout.split())
    assert text.startswith("usage: meander ")
    assert "need Blender: --object, " in text


def test_an_interruption_leaves_nothing(installed: Environment, ball: Path) -> None:
    output = installed.work / "interrupted.obj"
    running = subprocess.Popen(
        [installed.command, "--input", ball, "--spacing", "0.02", "--output", output],
        cwd=installed.work, env=installed.environment, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert "%" in running.stderr.readline()  # it is under way
    running.send_signal(signal.SIGINT)
    _out, err = running.communicate(timeout=60)
    assert running.returncode == 130
    assert err.splitlines()[-1] == "meander: interrupted"
    assert not output.exists()
