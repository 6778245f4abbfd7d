# SPDX-License-Identifier: GPL-3.0-or-later
"""A new version installed over the one that is in use: Blender reloads the package, and no more."""

from __future__ import annotations

import importlib
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import bpy
import meander
import pytest
from scenes import cube, fill

NAME = "meander_of_this_test"


@pytest.fixture
def installed(tmp_path: Path) -> Iterator[ModuleType]:
    """A copy of the add-on in a folder of its own, registered instead of the one under test."""
    shutil.copytree(
        Path(meander.__file__).parent,
        tmp_path / NAME,
        ignore=shutil.ignore_patterns("__pycache__"),
    )
    meander.unregister()
    sys.path.insert(0, str(tmp_path))
    package = importlib.import_module(NAME)
    package.register()
    yield package
    package.unregister()
    sys.path.remove(str(tmp_path))
    for name in [name for name in sys.modules if name.split(".")[0] == NAME]:
        del sys.modules[name]
    meander.register()


def submodules() -> dict[str, ModuleType]:
    return {name: module for name, module in sys.modules.items() if name.startswith(f"{NAME}.")}


def test_every_submodule_is_that_of_the_new_version(installed: ModuleType) -> None:
    fill(cube(), 0.5, use_bevel=True)  # what is imported late is there as well
    importlib.import_module(f"{NAME}.batch")
    before = submodules()
    assert f"{NAME}.core" in before and f"{NAME}.batch" in before

    folder = Path(installed.__file__).parent
    for path in folder.rglob("*.py"):
        path.write_text(path.read_text() + "\nOF_THE_NEW_VERSION = True\n")
    installed.unregister()
    importlib.reload(installed)
    installed.register()

    fill(cube(), 0.5, use_bevel=True)
    importlib.import_module(f"{NAME}.batch")
    after = submodules()
    assert set(after) == set(before)
    old = [name for name, module in after.items() if not hasattr(module, "OF_THE_NEW_VERSION")]
    assert not old, f"modules of the old version: {', '.join(sorted(old))}"
    # What a package offers by name is the new module as well, not what it was before.
    assert installed.core is after[f"{NAME}.core"]


def test_a_module_that_went_away_is_gone(installed: ModuleType) -> None:
    folder = Path(installed.__file__).parent
    (folder / "gone.py").write_text("")
    importlib.import_module(f"{NAME}.gone")
    installed.unregister()
    (folder / "gone.py").unlink()
    importlib.reload(installed)
    installed.register()
    with pytest.raises(ImportError):
        importlib.import_module(f"{NAME}.gone")
    assert bpy.ops.meander.run.get_rna_type().name == "Fill with Curve"
