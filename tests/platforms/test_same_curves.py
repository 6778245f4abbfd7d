# SPDX-License-Identifier: GPL-3.0-or-later
"""The libraries of all platforms that can be run here give the same bytes of curves."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import ROOT, TARGETS, library_of, platforms

HERE = Path(__file__).resolve().parent
RUN = [p for p in platforms() if p in ("linux-x64", "linux-arm64", "windows-x64")]
LONG = bool(os.environ.get("MEANDER_LONG"))
# Emulators take up to twenty times as long; these two presets are in every run.
SHORT = ("paper_sheet", "straight_sheet")


@pytest.fixture(scope="module")
def on_this_machine(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The curves of the library that this system's own compiler has built."""
    libraries = sorted((ROOT / "build/lib").glob("libmeander-*.so"))
    if not libraries:
        pytest.skip("no library of this system's compiler: scripts/build.sh makes it")
    program = tmp_path_factory.mktemp("here") / "curve_bytes"
    subprocess.run(["cc", "-std=c99", "-O1", f"-I{ROOT / 'native/include'}",
                    HERE / "curve_bytes.c", libraries[-1],
                    f"-Wl,-rpath,{libraries[-1].parent}", "-o", program],
                   check=True, timeout=60)
    cases = () if LONG else SHORT
    return subprocess.run([program, *cases], check=True, capture_output=True, text=True,
                          timeout=300).stdout


@pytest.mark.parametrize("emulated", RUN)
def test_same_curves(
    emulated: str, on_this_machine: str, zig: Callable[..., None], runner: Callable[..., str],
    tmp_path: Path,
) -> None:
    library = library_of(emulated)
    program = tmp_path / ("curve_bytes.exe" if emulated.startswith("windows") else "curve_bytes")
    linked = library
    if emulated.startswith("windows"):
        shutil.copy(library, tmp_path)  # where a program looks first
        linked = library.with_name(f"lib{library.name}.a")
    # With the level and -s of the library, for which Zig has built its runtime.
    zig("cc", "-target", TARGETS[emulated], "-std=c99", "-O2", "-s", "-ffp-contract=off",
        "-I", ROOT / "native/include",
        HERE / "curve_bytes.c", linked, f"-Wl,-rpath,{library.parent}", "-o", program)
    curves = runner(emulated, program, *(() if LONG else SHORT))
    assert len(on_this_machine.splitlines()) == (8 if LONG else len(SHORT))
    assert curves == on_this_machine
