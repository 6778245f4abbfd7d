# SPDX-License-Identifier: GPL-3.0-or-later
"""The same sources give the same bytes, in whatever folder they lie."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import ROOT, library_of, platforms

pytestmark = pytest.mark.skipif(
    not os.environ.get("MEANDER_LONG"), reason="builds a library again, which takes minutes"
)
# All are made in the same manner by the same compiler; one of each linker.
AGAIN = [p for p in platforms() if p in ("linux-x64", "windows-x64", "macos-arm64")]


@pytest.mark.parametrize("built_again", AGAIN)
def test_from_another_folder(built_again: str, tmp_path: Path) -> None:
    folder = tmp_path / "another folder"
    folder.mkdir()
    for name in ("native", "cmake", "scripts"):
        shutil.copytree(ROOT / name, folder / name)
    for name in ("CMakeLists.txt", "CMakePresets.json"):
        shutil.copy(ROOT / name, folder)
    (folder / "addon/meander/binding").mkdir(parents=True)
    (folder / "build").mkdir()
    (folder / "build/package-tools").symlink_to(ROOT / "build/package-tools")
    for command in (["cmake", "--preset"], ["cmake", "--build", "--preset"]):
        done = subprocess.run([*command, built_again], cwd=folder, capture_output=True,
                              text=True, timeout=1800)
        assert done.returncode == 0, done.stdout + done.stderr
    first = library_of(built_again)
    second = folder / "build/package" / built_again / "lib" / first.name
    assert second.read_bytes() == first.read_bytes()
