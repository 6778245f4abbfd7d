# SPDX-License-Identifier: GPL-3.0-or-later
"""Whoever stops reading what the command says, as `| head -1` does, does not end its run."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import geometry
import pytest
from conftest import PACKAGE

# What is closed, and what is said on the way: nothing, progress and remarks, a warning, an error.
ENDS = ["stdout", "stderr", "both"]
RUNS = {
    "quiet": (["--quiet"], 0),
    "told": ([], 0),
    "warned": (["--length", "9"], 0),
    "refused": (["--spacing", "-1"], 2),
}


@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("name", RUNS)
def test_the_run_goes_on(tmp_path: Path, name: str, end: str) -> None:
    mesh = geometry.write_obj(tmp_path / "square.obj", geometry.grid(6))
    output, (extra, code) = tmp_path / "out.obj", RUNS[name]
    command = [sys.executable, str(PACKAGE / "batch.py"), "--input", str(mesh)]
    command += ["--output", str(output), "--spacing", "0.4", "--iterations", "3", *extra]
    read, write = os.pipe()
    os.close(read)
    closed = ("stdout", "stderr") if end == "both" else (end,)
    streams = {each: write if each in closed else subprocess.DEVNULL for each in ENDS[:2]}
    ended = subprocess.run(command, timeout=60, **streams)
    os.close(write)
    assert ended.returncode == code
    assert output.exists() == (code == 0)
