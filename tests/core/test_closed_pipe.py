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


def _command(tmp_path: Path, *extra: str) -> tuple[list[str], Path]:
    mesh = geometry.write_obj(tmp_path / "square.obj", geometry.grid(6))
    output = tmp_path / "out.obj"
    command = [sys.executable, str(PACKAGE / "batch.py"), "--input", str(mesh), "--spacing", "0.4"]
    return [*command, "--iterations", "3", *extra], output


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no full device")
@pytest.mark.parametrize("end", ENDS)
def test_a_full_disk_behind_what_is_said_ends_no_run(tmp_path: Path, end: str) -> None:
    command, output = _command(tmp_path)
    with open("/dev/full", "wb") as full:
        closed = ("stdout", "stderr") if end == "both" else (end,)
        streams = {each: full if each in closed else subprocess.DEVNULL for each in ENDS[:2]}
        ended = subprocess.run([*command, "--output", str(output)], timeout=60, **streams)
    assert (ended.returncode, output.exists()) == (0, True)


@pytest.mark.skipif(os.name == "nt", reason="needs a shell that closes streams")
@pytest.mark.parametrize("closed", ["2>&-", ">&- 2>&-"])
def test_without_a_stderr_nothing_is_said_elsewhere(tmp_path: Path, closed: str) -> None:
    command, output = _command(tmp_path)
    shell = ["sh", "-c", f'exec "$@" {closed}', "sh", *command, "--output", "-"]
    ended = subprocess.run([*shell, "--output-format", "obj"], capture_output=True, timeout=60)
    if ">&- " in closed:
        assert (ended.returncode, ended.stdout) == (2, b"")  # there is nowhere to write to
    else:
        assert ended.returncode == 0
        assert ended.stdout.startswith(b"# Meander")
        assert b"meander: " not in ended.stdout
    assert not output.exists()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no full device")
def test_a_standard_output_without_room_is_one_sentence(tmp_path: Path) -> None:
    command, _output = _command(tmp_path, "--output", "-", "--output-format", "obj", "--quiet")
    with open("/dev/full", "wb") as full:
        ended = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, timeout=60)
    assert ended.returncode == 2
    (line,) = ended.stderr.decode().splitlines()
    assert "the standard output cannot be written (No space left on device)" in line


def test_an_interruption_while_it_begins_is_one_sentence(tmp_path: Path) -> None:
    (tmp_path / "numpy.py").write_text("raise KeyboardInterrupt\n")
    command, _output = _command(tmp_path)
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
    assert (ended.returncode, ended.stderr) == (130, "meander: interrupted\n")
