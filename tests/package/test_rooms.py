# SPDX-License-Identifier: GPL-3.0-or-later
"""What may import what in the add-on, as .importlinter says, and that it bites; how the files of a
feature are called."""

from __future__ import annotations

import ast
import graphlib
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
OF_ROOMS = "A room uses only the rooms below it"
OF_MODEL = "A part of the model uses only the parts below it"


def lint(bpy_python: Path, parent: Path) -> subprocess.CompletedProcess:
    """Judges the package `meander` in the folder `parent`."""
    command = [bpy_python.parent / "lint-imports", "--no-cache", "--config", ROOT / ".importlinter"]
    return subprocess.run(
        command, cwd=parent, env={**os.environ, "PYTHONPATH": str(parent)},
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip


def test_the_rooms_are_in_order(bpy_python: Path) -> None:
    done = lint(bpy_python, ROOT / "addon")
    assert done.returncode == 0, done.stdout + done.stderr


# By the rule that each is against: a module, and a line at its end.
BREACHES = {
    # One step the wrong way each; a deferred import is one as well.
    OF_ROOMS: (
        ("binding/seed.py", "from .. import core"),
        ("core.py", "from .model.geometry import thinning"),
        ("model/bundle.py", "from ..scene import density"),
        ("scene/density.py", "from ..run import pace"),
        ("run/plan.py", "from ..ui import settings"),
        ("run/plan.py", "from ..cli import values"),
        ("ui/panels.py", "from ..cli import values"),
        ("cli/reading.py", "from ..ui import panels"),
        ("cli/reading.py", "from ..jobs import items"),
        ("run/session.py", "def _late():\n    from ..ui import panels"),
        ("ui/panels.py", "from ..headless import host"),
    ),
    OF_MODEL: (
        ("model/geometry/thinning.py", "from ..files import whole"),
        ("model/files/whole.py", "from ..geometry import thinning"),
        ("model/geometry/thinning.py", "from ..toolpaths import drawing"),
        ("model/toolpaths/drawing.py", "from ..options import option"),
        ("model/options/option.py", "from .. import export"),
    ),
    # The layers alone would let the deferred two pass.
    "The Python package knows nothing of Blender": (
        ("model/geometry/thinning.py", "import bpy"),
        ("cli/reading.py", "import bpy"),
        ("jobs/items.py", "import bpy"),
        ("cli/reading.py", "def _late():\n    from ..scene import errors"),
        ("cli/writing.py", "from ..run import bake"),
        ("binding/abi.py", "def _late():\n    import mathutils"),
    ),
    "Only the binding knows ctypes": (
        ("model/geometry/thinning.py", "import ctypes"),
        ("core.py", "import ctypes"),
        ("ui/panels.py", "from ctypes import c_int"),
    ),
    "Only core knows the binding": (
        ("run/plan.py", "from ..binding import flow"),
        ("jobs/items.py", "from ..binding import abi"),
    ),
}


def test_every_import_against_a_rule_is_found(bpy_python: Path, tmp_path: Path) -> None:
    """All of them in one copy of the add-on: each is named under the rule that it is against."""
    package = tmp_path / "meander"
    shutil.copytree(ROOT / "addon/meander", package, ignore=shutil.ignore_patterns("native"))
    wanted = []
    for rule, breaches in BREACHES.items():
        for module, line in breaches:
            text = (package / module).read_text() + f"\n{line}\n"
            (package / module).write_text(text)
            name = f"meander.{module.removesuffix('.py').replace('/', '.')}"
            wanted.append((rule, name, text.count("\n")))
    done = lint(bpy_python, tmp_path)
    assert done.returncode == 1, done.stdout + done.stderr
    said = re.sub(r"\x1b\[\d+m", "", done.stdout).partition("\nBroken contracts\n")[2]
    # A title is underlined.
    _before, *parts = re.split(r"\n(.+)\n-+\n", said)
    found = dict(zip(parts[::2], parts[1::2]))
    assert found.keys() == BREACHES.keys()
    missed = [
        (rule, name, number)
        for rule, name, number in wanted
        if not re.search(rf"(?m)^- +{re.escape(name)} -> \S+ \(l\.{number}\)$", found[rule])
    ]
    assert missed == [], done.stdout


def test_a_room_that_the_rule_does_not_know_is_found(bpy_python: Path, tmp_path: Path) -> None:
    package = tmp_path / "meander"
    shutil.copytree(ROOT / "addon/meander", package, ignore=shutil.ignore_patterns("native"))
    (package / "attic").mkdir()
    (package / "attic/__init__.py").touch()
    done = lint(bpy_python, tmp_path)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "attic" in done.stdout


def test_one_module_knows_the_versions_of_blender() -> None:
    addon = ROOT / "addon/meander"
    asking = {
        path.relative_to(addon).as_posix()
        for path in addon.rglob("*.py")
        if re.search(r"app\.version\b|app\.version_file", path.read_text(encoding="utf-8"))
    }
    assert asking == {"scene/blender_versions.py"}


# Symmetry is too long for one file. What upgrades a look reads curves, and these know the look.
SEVERAL_FILES = {
    "binding/flow_options.py", "model/mirror_images.py", "model/mirror_whole.py",
    "scene/look_upgrade.py",
}  # fmt: skip


def smeared(addon: Path) -> set[str]:
    """The files that are called after a feature, but have not its very name.

    A feature is what files of one name in two rooms are about.
    """
    files = [path.relative_to(addon) for path in addon.rglob("*.py") if "__" not in path.name]
    rooms: dict[str, set[str]] = {}
    for file in files:
        rooms.setdefault(file.stem, set()).add(file.parts[0])
    features = "|".join(f"{name.rstrip('s')}s?" for name in rooms if len(rooms[name]) > 1)
    return {file.as_posix() for file in files if re.match(rf"({features})_", file.stem)}


def test_a_feature_is_one_word_in_every_room() -> None:
    found = smeared(ROOT / "addon/meander")
    assert found - SEVERAL_FILES == set(), "a feature has one file of its name in each room"
    assert found == SEVERAL_FILES, "no exception is left over"


def test_a_second_file_of_a_feature_is_found(tmp_path: Path) -> None:
    for name in ("run/seeds.py", "ui/seeds.py", "ui/seed_drawing.py", "ui/cut_panel.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    assert smeared(tmp_path) == {"ui/seed_drawing.py"}


def imports_of(addon: Path) -> dict[str, set[str]]:
    """What each file of the package imports of the others, for types as well, by dotted names."""
    names = {}
    for path in addon.rglob("*.py"):
        dotted = ".".join(path.relative_to(addon.parent).with_suffix("").parts)
        names[dotted.removesuffix(".__init__")] = path
    found: dict[str, set[str]] = {name: set() for name in names}
    for name, path in names.items():
        room = name if path.name == "__init__.py" else name.rpartition(".")[0]
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.ImportFrom) or not node.level:
                continue
            parts = room.split(".")
            above = ".".join((*parts[: len(parts) - node.level + 1], *filter(None, [node.module])))
            for each in node.names:
                module = f"{above}.{each.name}"
                found[name].add(module if module in names else above)
    # The package's own file lets everything in, and is let in by everything.
    root = addon.name
    return {name: own - {root} for name, own in found.items() if name != root}


def test_no_files_import_one_another_in_a_circle(tmp_path: Path) -> None:
    graphlib.TopologicalSorter(imports_of(ROOT / "addon/meander")).prepare()
    package = tmp_path / "meander"
    shutil.copytree(ROOT / "addon/meander", package, ignore=shutil.ignore_patterns("native"))
    late = package / "run/lasting.py"
    late.write_text(late.read_text() + "\nif TYPE_CHECKING:\n    from .session import Session\n")
    with pytest.raises(graphlib.CycleError, match="meander.run.session"):
        graphlib.TopologicalSorter(imports_of(package)).prepare()


def test_few_functions_set_what_is_global() -> None:
    """What lasts between two events of `run` and `ui` is kept as run.lasting says."""
    setting = [
        path.relative_to(ROOT / "addon/meander").parts[0]
        for path in (ROOT / "addon/meander").rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Global)
    ]
    assert set(setting) <= {"binding", "scene"} and len(setting) <= 5
