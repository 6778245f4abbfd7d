# SPDX-License-Identifier: GPL-3.0-or-later
"""What is too large is refused before it begins, with what it would cost and the flag to raise."""

from __future__ import annotations

import json
import re
import threading
from pathlib import Path
from types import ModuleType

import geometry
import pytest
from meander import batch, core
from meander.cli import command, limits, watching, writing
from meander.cli.place import Place
from meander.model.estimate import available_memory
from sentences import assert_sentence

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"


class Square:
    """A square, and the batch command on it."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture) -> None:
        self.folder, self._capsys = folder, capsys
        self.mesh, self.output = folder / "square.obj", folder / "out.obj"
        self.report = folder / "report.json"
        self.mesh.write_text(SQUARE)

    def fill(self, *options: object) -> int:
        return self._run("--iterations", 2, "--quiet", *options)

    def told(self, *options: object) -> str:
        """What is said of a run that ends well."""
        assert self._run(*options) == 0
        return self._capsys.readouterr().out

    def _run(self, *options: object) -> int:
        given = ["--input", self.mesh, "--output", self.output, "--report", self.report, *options]
        return batch.main([str(item) for item in given])

    def refusal(self, *options: object) -> str:
        """What is said of a run that is refused; nothing is written."""
        before = sorted(self.folder.iterdir())
        assert self.fill(*options) == 2
        said = self._capsys.readouterr().err.rstrip("\n")
        assert_sentence(said)
        assert sorted(self.folder.iterdir()) == before
        return said


@pytest.fixture
def square(tmp_path: Path, capsys: pytest.CaptureFixture) -> Square:
    return Square(tmp_path, capsys)


def test_more_nodes_than_are_wanted(square: Square) -> None:
    said = square.refusal("--spacing", 0.1, "--limit-nodes", 100)
    assert "--limit-nodes" in said and "MB" in said and " of a processor" in said
    assert square.fill("--spacing", 0.1, "--limit-nodes", 10_000) == 0


def test_nodes_are_limited_where_memory_is_not_known(
    square: Square, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Elsewhere the memory is the limit, however many nodes it holds."""
    monkeypatch.setattr(limits, "available_memory", lambda: None)
    said = square.refusal("--spacing", 3e-4)
    assert "--limit-nodes is 5,000,000" in said
    monkeypatch.setattr(limits, "available_memory", lambda: 2_000_000_000)
    said = square.refusal("--spacing", 3e-4)
    assert "2 GB are available" in said and "--limit-nodes" not in said


def test_what_no_flag_helps_against_is_said_by_the_library(square: Square) -> None:
    said = square.refusal("--spacing", 1e-6, "--limit-nodes", 10**12, "--limit-memory", 1e12)
    assert "500 million" in said and "--limit" not in said
    assert "500 million" in square.refusal("--spacing", 1e-300)


def test_more_memory_than_is_wanted(square: Square) -> None:
    said = square.refusal("--spacing", 0.02, "--limit-memory", 1)
    assert "--limit-memory is 1 MB" in said
    assert square.fill("--spacing", 0.02, "--limit-memory", 1000) == 0


def test_more_memory_than_there_is(square: Square, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "available_memory", lambda: 1_000_000)
    said = square.refusal("--spacing", 0.02)
    assert "1 MB are available" in said and "--limit-memory MB" in said
    assert square.fill("--spacing", 0.02, "--limit-memory", 1000) == 0
    monkeypatch.setattr(limits, "available_memory", lambda: None)
    assert square.fill("--spacing", 0.02) == 0


def test_the_report_has_what_was_expected(square: Square) -> None:
    assert square.fill("--spacing", 0.05, "--preset", "paper", "--iterations", 300) == 0
    report = json.loads(square.report.read_text())
    assert report["estimate"]["nodes"] == pytest.approx(report["nodes"], rel=0.1)
    assert report["estimate"]["length"] == pytest.approx(report["length"], rel=0.1)
    assert report["options"]["limit_nodes"] is None


# ------------------------------------------------------------------------------------------------
# What is available


def kernel(folder: Path, group: str, **files: str) -> tuple[Path, Path]:
    """A /proc and a /sys/fs/cgroup; `files` are those of groups, by the names of both."""
    proc, groups = folder / "proc", folder / "groups"
    (proc / "self").mkdir(parents=True)
    (proc / "meminfo").write_text(
        "MemTotal:  16000000 kB\nMemFree:   100 kB\nMemAvailable:    8000000 kB\n"
    )
    (proc / "self" / "cgroup").write_text(group)
    for name, text in files.items():
        *parts, last = name.split("__")
        path = groups.joinpath(*parts, last.replace("_", ".", 1))
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return proc, groups


def test_of_a_machine(tmp_path: Path) -> None:
    assert available_memory(*kernel(tmp_path, "")) == 8_192_000_000


@pytest.mark.parametrize(
    ("current", "stat", "left"),
    [("100000", "anon 5\ninactive_file 20000\n", 420_000), ("900000", "", 0)],
)
def test_of_a_group_with_a_limit(tmp_path: Path, current: str, stat: str, left: int) -> None:
    places = kernel(
        tmp_path,
        "0::/jobs/one\n",
        jobs__memory_max="500000",
        jobs__memory_current=current,
        jobs__memory_stat=stat,
        jobs__one__memory_max="max",
        jobs__one__memory_current="5",
    )
    assert available_memory(*places) == left


def test_of_groups_without_a_limit_or_of_another_version(tmp_path: Path) -> None:
    places = kernel(tmp_path, "1:memory:/old\n0::/\n", memory_max="max", memory_current="7")
    assert available_memory(*places) == 8_192_000_000


def test_of_this_machine() -> None:
    available = available_memory()
    assert available is None or available > 1_000_000


# ------------------------------------------------------------------------------------------------
# What is said meanwhile


def test_a_large_run_says_what_it_comes_to_and_what_it_is_about(
    square: Square, monkeypatch: pytest.MonkeyPatch
) -> None:
    """From before its first iteration to its file; a small one says none of it."""
    monkeypatch.setattr(watching, "_FIRST_SECONDS", 1e9)  # however slow the machine is
    said = square.told("--spacing", 0.1, "--iterations", 2)
    begun = [f"meander: {what}" for what in ("about ", "measuring", "writing", "wrote")]
    assert [what in said for what in begun] == [False, False, False, True]
    for module in (command, writing):
        monkeypatch.setattr(module, "LARGE", 10)
    said = square.told("--spacing", 0.1, "--iterations", 2)
    places = [said.index(what) for what in begun]
    assert places == sorted(places)
    assert " nodes, " in said and " of a processor\n" in said


@pytest.mark.parametrize(
    ("phase", "module", "name"),
    [
        ("reading .*square.obj,", command, "read_input"),
        ("preparing the mesh, 0%", command, "open_flow"),
    ],
)
def test_what_comes_before_a_run_is_said_while_it_lasts(
    phase: str,
    module: ModuleType,
    name: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Whatever takes its time: here it waits until a line is there."""
    lines: list[str] = []
    there, work = threading.Event(), getattr(module, name)

    def say(line: str) -> None:
        lines.append(line)
        if re.fullmatch(rf"meander: {phase} after [\d.]+ s", line):
            there.set()

    def slow(*given: object) -> object:
        assert there.wait(60)
        return work(*given)

    monkeypatch.setattr(watching, "_FIRST_SECONDS", 0.0)
    monkeypatch.setattr(module, name, slow)
    mesh, output = tmp_path / "square.obj", tmp_path / "out.obj"
    mesh.write_text(SQUARE)
    options = ["--input", mesh, "--output", output, "--spacing", 0.1, "--iterations", 1]
    assert command.main([str(item) for item in options], Place("meander", say)) == 0
    assert there.is_set()


def test_a_surface_leaves_the_progress_of_a_run_as_it_is() -> None:
    vertices, faces = geometry.icosphere(3)
    options = core.default_options("even")
    options.radius, options.iteration_limit = 0.1, 3
    with core.Context() as context, core.Surface(vertices, faces, context=context) as surface:
        assert context.progress == 0.0
        with core.Flow(surface, options, context=context) as flow:
            assert context.progress == 0.0
            flow.run(context)
            assert context.progress == 1.0
        core.Surface(vertices, faces, context=context).close()
        assert context.progress == 1.0


def test_the_phase_of_a_run_is_said(square: Square, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(watching, "_FIRST_SECONDS", 0.0)
    monkeypatch.setattr(watching, "_PROGRESS_SECONDS", 0.0)
    said = square.told("--spacing", 0.03, "--iterations", 30)
    phases = "preparing|growing|removing hairpins|evening out"
    found = re.findall(rf"^meander: ({phases}), (\d+)% after [\d.]+ s$", said, re.MULTILINE)
    assert found
    shares = [int(share) for _phase, share in found]
    assert shares == sorted(shares)
