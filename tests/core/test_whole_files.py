# SPDX-License-Identifier: GPL-3.0-or-later
"""Files appear whole or not at all: on a full disk, under kill -9, beside another writer, where
nothing may be written. `test_batch_outputs.py` has what holds while nothing goes wrong."""

from __future__ import annotations

import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from conftest import PACKAGE
from meander import batch, core
from meander.model import export, report
from meander.model.files import obj, whole
from meander.model.toolpaths import toolpath
from sentences import assert_sentence

resource = pytest.importorskip("resource", reason="of POSIX systems")

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"
# What the batch command writes without Blender, beside a report and a cut.
OUTPUTS = ["obj", "csv", "json", "svg", "dxf", "gcode"]
NOBODY = 65534  # the user without rights, where tests run as root


def run(folder: Path, *extra: object) -> int:
    """The batch command on a square in a folder, with two iterations."""
    square = folder / "square.obj"
    if not square.exists():
        square.write_text(SQUARE)
    given = ["--input", square, "--spacing", 0.2, "--iterations", 2, "--quiet", *extra]
    return batch.main([str(item) for item in given])


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


# ------------------------------------------------------------------------------------------------
# A full disk


@contextmanager
def files_no_longer_than(size: int) -> Iterator[None]:
    """Every file that grows beyond this fails as on a full disk; Python ignores the signal."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.mark.parametrize("there", [True, False])
@pytest.mark.parametrize("suffix", OUTPUTS)
def test_no_output_is_cut_short_where_nothing_fits(
    tmp_path: Path, capsys: pytest.CaptureFixture, suffix: str, there: bool
) -> None:
    output, written = tmp_path / f"curve.{suffix}", tmp_path / "report.json"
    cut = tmp_path / ("cut.ply" if there else "cut.obj")
    options = ["--output", output, "--report", written, "--cut", cut]
    options += ["--layout", "top"] if suffix in ("svg", "dxf", "gcode") else []
    (tmp_path / "square.obj").write_text(SQUARE)
    if there:
        for path in (output, written, cut):
            path.write_text("earlier")
    before = contents(tmp_path)
    with files_no_longer_than(500):
        assert run(tmp_path, *options) == 2
    error = capsys.readouterr().err.rstrip("\n")
    assert_sentence(error)
    assert str(output) in error  # and not the name that it has meanwhile
    assert contents(tmp_path) == before
    assert run(tmp_path, *options) == 0
    assert all(len(path.read_bytes()) > 500 for path in (output, written, cut))


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of its own with room for 64 KB."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mounted = shutil.which("mount") is not None and os.geteuid() == 0
    if not mounted or subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=64k", "none", str(folder)], capture_output=True
    ).returncode:
        pytest.skip("only root can mount a file system, and not in every container")
    yield folder
    subprocess.run(["umount", str(folder)], check=True)


def test_a_disk_that_is_full(small_disk: Path, capsys: pytest.CaptureFixture) -> None:
    output, written = small_disk / "curve.json", small_disk / "report.json"
    for path in (output, written):
        path.write_text("earlier")
    filler = small_disk / "filler"
    filler.write_bytes(bytes(40_000))
    before = contents(small_disk)
    square = small_disk.parent / "square.obj"
    square.write_text(SQUARE)
    options = ["--output", output, "--report", written]
    assert run(small_disk.parent, *options, "--spacing", 0.05) == 2
    error = capsys.readouterr().err.rstrip("\n")
    assert_sentence(error)
    assert "No space left" in error
    assert contents(small_disk) == before
    filler.unlink()
    assert run(small_disk.parent, *options, "--spacing", 0.2) == 0
    assert sorted(contents(small_disk)) == ["curve.json", "report.json"]


def test_what_takes_a_name_is_on_the_disk(tmp_path: Path, monkeypatch) -> None:
    # A rename may reach the disk before the contents do: after a power cut the file is empty.
    path, done = tmp_path / "out.obj", []
    flush, move = os.fsync, os.replace

    def noted_flush(handle: int) -> None:
        status = os.fstat(handle)
        done.append(("flush", status.st_ino, status.st_size))
        flush(handle)

    def noted_move(source: object, target: object) -> None:
        done.append(("move", os.stat(source).st_ino, os.stat(source).st_size))
        move(source, target)

    monkeypatch.setattr(os, "fsync", noted_flush)
    monkeypatch.setattr(os, "replace", noted_move)
    with whole.whole_file(path) as temporary:
        temporary.write_text("all of it")
    number = path.stat().st_ino
    moved = done.index(("move", number, 9))
    assert ("flush", number, 9) in done[:moved]
    assert ("flush", tmp_path.stat().st_ino) in [entry[:2] for entry in done[moved:]]


def test_a_disk_that_fails_when_it_is_flushed(tmp_path: Path, monkeypatch, capsys) -> None:
    # Network file systems say only then that there is no room. Whenever that is, either all files
    # are there or none is.
    (tmp_path / "square.obj").write_text(SQUARE)
    files = {option: tmp_path / name for option, name in (
        ("--output", "curve.obj"), ("--cut", "cut.ply"), ("--report", "report.json")
    )}  # fmt: skip
    files["--output"].write_text("earlier")
    before = contents(tmp_path)
    flush, failed, calls = os.fsync, 0, 0

    def full(handle: int) -> None:
        nonlocal calls
        calls += 1
        if calls == failed:
            raise OSError(28, "No space left on device")
        flush(handle)

    monkeypatch.setattr(os, "fsync", full)
    codes = []
    while failed == 0 or calls >= failed:
        failed, calls = failed + 1, 0
        codes.append(run(tmp_path, *(item for pair in files.items() for item in pair)))
        if codes[-1] == 0:  # a folder could not be flushed, which undoes nothing
            assert len(contents(tmp_path)) == 4
            for path in files.values():
                path.unlink()
            files["--output"].write_text("earlier")
        else:
            assert codes[-1] == 2 and contents(tmp_path) == before
            error = capsys.readouterr().err.rstrip("\n")
            assert_sentence(error)
            assert any(str(path) in error for path in files.values()), error
    assert codes.count(2) >= 3


# ------------------------------------------------------------------------------------------------
# Killed while writing, and two at once


def lines_of(points: int) -> core.Polylines:
    """A curve of so many points, whose file is about 60 bytes long for each."""
    positions = np.random.default_rng(points).normal(size=(points, 3))
    offsets = np.array([0, points], dtype=np.uint32)
    return core.Polylines(
        positions, np.zeros_like(positions), offsets, np.array([0], dtype=np.uint8)
    )


def strands_of(points: int) -> list[toolpath.Strand]:
    return list(toolpath.strands_of(lines_of(points)))


def write_drawing(suffix: str, path: Path, points: int) -> None:
    values = dict(export.DEFAULTS)
    kind = export.format_of(Path(f"a.{suffix}"))
    drawing = export.prepared(strands_of(points), kind, values, 1.0)
    export.write(path, kind, drawing, values, "title", "0")


def write_report(path: Path, points: int) -> None:
    report.write_report(path, {"numbers": list(range(points))})


WRITERS: dict[str, Callable[[Path, int], None]] = {
    "obj": lambda path, points: obj.write_obj_curve(path, lines_of(points)),
    "json": write_report,
    "csv": lambda path, points: toolpath.write(path, strands_of(points), "0"),
    "svg": partial(write_drawing, "svg"),
    "gcode": partial(write_drawing, "gcode"),
}
SIZES = (300, 500)


@contextmanager
def writing(*writers: Callable[[], None]) -> Iterator[list[int]]:
    """Processes that each write over and over, until they are killed at the end."""
    numbers = []
    try:
        for write in writers:
            number = os.fork()
            if number == 0:
                try:
                    while True:
                        write()
                finally:
                    os._exit(1)
            numbers.append(number)
        yield numbers
    finally:
        for number in numbers:
            os.kill(number, signal.SIGKILL)
            _, status = os.waitpid(number, 0)
            assert os.WTERMSIG(status) == signal.SIGKILL, "a writer has failed"


def whole_versions(folder: Path, suffix: str) -> dict[int, bytes]:
    """What each size of a curve looks like in a file, by its size."""
    found = {}
    for size in SIZES:
        WRITERS[suffix](folder / f"version.{suffix}", size)
        found[size] = (folder / f"version.{suffix}").read_bytes()
    assert len(set(found.values())) == len(SIZES)
    return found


@pytest.mark.parametrize("suffix", list(WRITERS))
def test_a_writer_that_is_killed_leaves_a_whole_file(tmp_path: Path, suffix: str) -> None:
    versions = whole_versions(tmp_path, suffix)
    target = tmp_path / "out" / f"curve.{suffix}"
    target.parent.mkdir()
    random_pause = random.Random(suffix)
    left_over = 0
    for _round in range(12):
        target.write_bytes(versions[SIZES[0]])
        with writing(lambda: [WRITERS[suffix](target, size) for size in reversed(SIZES)]):
            time.sleep(random_pause.uniform(0.002, 0.03))
        assert target.read_bytes() in versions.values()
        for path in target.parent.iterdir():
            if path != target:
                left_over += 1
                assert path.name.startswith(".") and ".tmp" in path.name
                path.unlink()
    assert left_over > 0, "no writer was killed in the middle of a file"


@pytest.mark.parametrize("suffix", ["obj", "json"])
def test_two_writers_of_one_file_leave_one_of_both(tmp_path: Path, suffix: str) -> None:
    versions = whole_versions(tmp_path, suffix)
    target = tmp_path / "out" / f"curve.{suffix}"
    target.parent.mkdir()
    target.write_bytes(versions[SIZES[0]])
    seen = set()
    ending = time.monotonic() + 5.0
    with writing(*(partial(WRITERS[suffix], target, size) for size in SIZES)):
        while len(seen) < 2 and time.monotonic() < ending or len(seen) == 0:
            for _read in range(200):
                read = target.read_bytes()
                assert read in versions.values()
                seen.add(read)
    assert len(seen) == 2, "only one of both was seen to write"


# ------------------------------------------------------------------------------------------------
# Where nothing may be written

AS_NOBODY = """
import importlib.util, os, sys
package = sys.argv[1]
place = importlib.util.spec_from_file_location("meander", package + "/__init__.py",
                                               submodule_search_locations=[package])
sys.modules["meander"] = importlib.util.module_from_spec(place)
place.loader.exec_module(sys.modules["meander"])
from meander import batch, core
core.library_version()  # may lie where only its owner can read
if os.geteuid() == 0:
    os.setgroups([])
    os.setgid(65534)
    os.setuid(65534)
sys.exit(batch.main(sys.argv[2:]))
"""


@pytest.fixture
def open_folder() -> Iterator[Path]:
    """A folder that every user can reach, which those of pytest are not."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o755)
        (folder / "square.obj").write_text(SQUARE)
        yield folder
        for path in folder.rglob("*"):
            path.chmod(0o755)


def run_as_nobody(folder: Path, *options: object) -> subprocess.CompletedProcess:
    given = ["--input", folder / "square.obj", "--spacing", 0.2, "--iterations", 2, *options]
    return subprocess.run(
        [sys.executable, "-c", AS_NOBODY, str(PACKAGE), *map(str, given)],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip


def test_a_folder_that_may_not_be_written(open_folder: Path) -> None:
    closed = open_folder / "closed"
    closed.mkdir()
    (closed / "curve.obj").write_text("earlier")
    (closed / "curve.obj").chmod(0o666)
    closed.chmod(0o555)
    done = run_as_nobody(open_folder, "--output", closed / "curve.obj")
    assert done.returncode == 2, done.stderr
    assert_sentence(done.stderr.rstrip("\n"))
    assert contents(closed) == {"curve.obj": b"earlier"}


@pytest.mark.parametrize("option", ["--output", "--report"])
def test_a_file_that_is_protected_is_not_replaced(open_folder: Path, option: str) -> None:
    folder = open_folder / "open"
    folder.mkdir()
    kept = folder / "kept.obj"
    kept.write_text("earlier")
    kept.chmod(0o444)
    folder.chmod(0o777)
    given = {"--output": folder / "curve.obj"} | {option: kept}
    done = run_as_nobody(open_folder, *(item for pair in given.items() for item in pair))
    assert done.returncode == 2, done.stderr
    assert_sentence(done.stderr.rstrip("\n"))
    assert option in done.stderr and "protected" in done.stderr
    assert contents(folder) == {"kept.obj": b"earlier"}


def test_a_file_that_may_be_written_but_not_read(open_folder: Path) -> None:
    output = open_folder / "curve.obj"
    output.write_text("earlier")
    output.chmod(0o200)
    if os.geteuid() == 0:
        os.chown(output, NOBODY, NOBODY)
    open_folder.chmod(0o777)
    done = run_as_nobody(open_folder, "--output", output, "--quiet")
    assert done.returncode == 0, done.stderr
    assert output.stat().st_mode & 0o777 == 0o200
    output.chmod(0o600)
    assert output.read_text() != "earlier"


def test_a_protected_file_is_not_replaced_by_an_export(open_folder: Path) -> None:
    kept = open_folder / "kept.svg"
    kept.write_text("earlier")
    kept.chmod(0o444)
    open_folder.chmod(0o777)
    number = os.fork()
    if number == 0:
        code = 1
        try:
            if os.geteuid() == 0:
                os.setgroups([])
                os.setgid(NOBODY)
                os.setuid(NOBODY)
            write_drawing("svg", kept, 10)
        except whole.FileError as refusal:
            assert_sentence(str(refusal))
            code = 0
        finally:
            os._exit(code)
    assert os.waitpid(number, 0)[1] == 0
    assert kept.read_text() == "earlier"


@pytest.mark.skipif(os.geteuid() != 0, reason="only root writes files of other users")
def test_root_leaves_a_file_to_its_owner(tmp_path: Path) -> None:
    path = tmp_path / "out.obj"
    path.write_text("earlier")
    os.chown(path, 1234, 2345)
    path.chmod(0o640)
    with whole.whole_file(path) as temporary:
        temporary.write_text("later")
    status = path.stat()
    assert (status.st_uid, status.st_gid, status.st_mode & 0o777) == (1234, 2345, 0o640)
    assert path.read_text() == "later"


# ------------------------------------------------------------------------------------------------
# What goes in is never what goes out


@pytest.mark.parametrize("option", ["--output", "--report", "--cut"])
@pytest.mark.parametrize("link", [os.link, os.symlink])
def test_another_name_of_the_input_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture, option: str, link: Callable
) -> None:
    square, other = tmp_path / "square.obj", tmp_path / "other.obj"
    square.write_text(SQUARE)
    link(square, other)
    given = {"--output": tmp_path / "curve.obj"} | {option: other}
    assert run(tmp_path, *(item for pair in given.items() for item in pair)) == 2
    error = capsys.readouterr().err.rstrip("\n")
    assert_sentence(error)
    assert "overwrite" in error
    assert square.read_text() == other.read_text() == SQUARE
    assert not (tmp_path / "curve.obj").exists()
