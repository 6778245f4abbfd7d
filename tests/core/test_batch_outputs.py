# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the batch command writes: whole or not at all, through links, and with the modes there."""

from __future__ import annotations

import json
import os
import stat
import threading
from pathlib import Path

import pytest
from flows import fill
from meander.model import report
from meander.model.files import obj
from sentences import assert_sentence

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"


@pytest.fixture
def square(tmp_path: Path) -> Path:
    path = tmp_path / "square.obj"
    path.write_text(SQUARE)
    return path


def run(square: Path, output: Path, *extra: object) -> int:
    return fill(square, output, "--spacing", 0.4, "--iterations", 2, "--quiet", *extra)


def names(folder: Path) -> list[str]:
    return sorted(item.name for item in folder.iterdir())


def mode_of(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@pytest.mark.parametrize("option", ["--input", "--output", "--report", "--seed", "--guides"])
def test_a_name_that_is_too_long_is_a_sentence(
    square: Path, tmp_path: Path, capsys: pytest.CaptureFixture, option: str
) -> None:
    before = names(tmp_path)
    code = run(square, tmp_path / "out.obj", option, tmp_path / ("n" * 300 + ".obj"))
    error = capsys.readouterr().err
    assert code == 2, error
    assert_sentence(error.rstrip("\n"))
    assert option in error or option in ("--seed", "--guides")
    assert names(tmp_path) == before


@pytest.mark.parametrize("suffix", [".obj", ".csv", ".json"])
def test_a_name_as_long_as_names_may_be(square: Path, tmp_path: Path, suffix: str) -> None:
    longest = os.pathconf(tmp_path, "PC_NAME_MAX")
    output = tmp_path / ("n" * (longest - len(suffix)) + suffix)
    written = tmp_path / ("r" * longest)
    assert run(square, output, "--report", written) == 0
    assert names(tmp_path) == sorted([square.name, output.name, written.name])


@pytest.mark.parametrize("there", [True, False])
def test_a_link_is_written_through(square: Path, tmp_path: Path, there: bool) -> None:
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    for name in ("curve.obj", "report.json"):
        (tmp_path / name).symlink_to(folder / f"real-{name}")
        if there:
            (folder / f"real-{name}").write_text("earlier")
    output, written = tmp_path / "curve.obj", tmp_path / "report.json"
    assert run(square, output, "--report", written) == 0
    assert output.is_symlink() and written.is_symlink()
    assert len(obj.read_obj_curve(folder / "real-curve.obj").points) > 3
    assert json.loads((folder / "real-report.json").read_text())["iterations"] == 2
    assert names(folder) == ["real-curve.obj", "real-report.json"]


def test_a_link_into_a_missing_folder_is_a_sentence(
    square: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    output = tmp_path / "curve.obj"
    output.symlink_to(tmp_path / "missing" / "curve.obj")
    assert run(square, output) == 2
    assert_sentence(capsys.readouterr().err.rstrip("\n"))


def test_a_link_to_the_input_is_refused(
    square: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    output = tmp_path / "curve.obj"
    output.symlink_to(square)
    assert run(square, output) == 2
    assert "overwrite" in capsys.readouterr().err
    assert square.read_text() == SQUARE


def test_a_loop_of_links_is_a_sentence(
    square: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    output, other = tmp_path / "curve.obj", tmp_path / "other.obj"
    output.symlink_to(other)
    other.symlink_to(output)
    assert run(square, output) == 2
    assert_sentence(capsys.readouterr().err.rstrip("\n"))
    assert output.is_symlink() and other.is_symlink()


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o666])
@pytest.mark.parametrize("suffix", [".obj", ".csv", ".json"])
def test_a_file_keeps_its_mode(square: Path, tmp_path: Path, suffix: str, mode: int) -> None:
    output, written = tmp_path / f"curve{suffix}", tmp_path / "report.txt"
    for path in (output, written):
        path.write_text("earlier")
        path.chmod(mode)
    assert run(square, output, "--report", written) == 0
    assert output.read_text() != "earlier" and written.read_text() != "earlier"
    assert mode_of(output) == mode_of(written) == mode


def test_a_new_file_has_the_mode_of_any_other(square: Path, tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        assert run(square, tmp_path / "curve.obj", "--report", tmp_path / "report.json") == 0
    finally:
        os.umask(before)
    assert mode_of(tmp_path / "curve.obj") == mode_of(tmp_path / "report.json") == 0o640


def test_what_is_being_written_is_as_private_as_what_was_there(
    square: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    modes = []

    def spy(path: Path, _report: object) -> None:
        modes.append(mode_of(Path(path)))

    output, written = tmp_path / "curve.obj", tmp_path / "report.json"
    written.write_text("earlier")
    written.chmod(0o600)
    monkeypatch.setattr(report, "write_report", spy)
    assert run(square, output, "--report", written) == 0
    assert modes == [0o600]


def test_nothing_is_touched_when_the_second_file_fails(
    square: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output, written = tmp_path / "curve.obj", tmp_path / "report.json"
    for path in (output, written):
        path.write_text("earlier")

    def full(*_arguments: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(report, "write_report", full)
    assert run(square, output, "--report", written) == 2
    assert output.read_text() == written.read_text() == "earlier"
    assert names(tmp_path) == ["curve.obj", "report.json", "square.obj"]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_is_written_into(square: Path, tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.json"
    os.mkfifo(pipe)
    heard: list[str] = []
    listener = threading.Thread(target=lambda: heard.append(pipe.read_text()), daemon=True)
    listener.start()
    assert run(square, tmp_path / "curve.obj", "--report", pipe) == 0
    listener.join(timeout=10.0)
    assert json.loads(heard[0])["iterations"] == 2
    assert stat.S_ISFIFO(pipe.stat().st_mode)


@pytest.mark.parametrize("name", ["out.obj", "./out.obj", "a/../out.obj"])
def test_a_current_folder_that_has_been_deleted_is_a_sentence(
    square: Path, tmp_path: Path, capsys: pytest.CaptureFixture, monkeypatch, name: str
) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert run(square, Path(name)) == 2
    assert_sentence(capsys.readouterr().err.rstrip("\n"))
