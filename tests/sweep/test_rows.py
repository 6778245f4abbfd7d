# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever a run does, it leaves a row; and a sweep goes on where it ended."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
import sweep
from rows import Limits, Run, append_row, failed, read_rows, run_of, run_one

TIMES = ("creating", "flowing", "checking")
RUN = Run("cube", 1.0, "even", "geodesic", 1)


def row_of(folder: Path, script: str, limits: Limits) -> dict:
    """The row of a run of a program of its own."""
    program = folder / "program"
    program.write_text(f"#!{sys.executable}\nimport os, signal, sys, time\n{script}\n")
    program.chmod(0o755)
    return run_one(RUN, folder / "input", 0.1, limits, program)


def test_a_crash_is_a_row(tmp_path: Path) -> None:
    row = row_of(tmp_path, "os.kill(os.getpid(), signal.SIGSEGV)", Limits())
    assert (row["outcome"], row["reason"]) == ("crash", "SIGSEGV")
    assert failed(row) and run_of(row) == RUN


def test_a_hang_is_a_row(tmp_path: Path) -> None:
    row = row_of(tmp_path, "time.sleep(60)", Limits(clock=0.5))
    assert row["outcome"] == "hang" and failed(row)
    row = row_of(tmp_path, "while True: pass", Limits(processor=1, clock=60))
    assert row["outcome"] == "hang" and failed(row) and "of a processor" in row["reason"]


def test_a_run_that_waits_is_no_hang(tmp_path: Path) -> None:
    script = 'time.sleep(1.5); print(\'{"outcome": "limit"}\')'
    assert row_of(tmp_path, script, Limits(processor=1))["outcome"] == "limit"


def test_no_answer_is_a_row(tmp_path: Path) -> None:
    row = row_of(tmp_path, "sys.exit('no such file')", Limits())
    assert row["outcome"] == "no answer" and failed(row)
    assert row["reason"] == "exit code 1: no such file"


def test_memory_is_limited(tmp_path: Path) -> None:
    script = 'try: data = bytes(1 << 30)\nexcept MemoryError: print(\'{"outcome": "limit"}\')'
    assert row_of(tmp_path, script, Limits(memory=512 << 20))["outcome"] == "limit"
    assert row_of(tmp_path, script, Limits(memory=4 << 30))["outcome"] == "no answer"


def test_the_library_runs_out_of_memory_with_a_sentence(tmp_path: Path) -> None:
    from shapes import SHAPES

    limits = Limits(seconds=20, clock=100, memory=24 << 20)
    row = sweep.Sweep(SHAPES, tmp_path, limits).run(Run("saw", 0.1, "even", "geodesic", 1))
    assert row["outcome"] in ("out of memory", "no memory to check"), row


def test_what_is_wrong_with_a_curve_makes_a_run_fail() -> None:
    row = {"outcome": "converged", "reason": "", "faults": 0}
    assert not failed(row)
    assert failed({**row, "faults": 1})
    assert failed({**row, "outcome": "internal error"})
    assert failed({**row, "outcome": "refused"}), "without a reason"


@pytest.fixture
def swept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Sweeps a cube, and gives the names of the runs that were made."""

    def run(*more: str) -> tuple[list[str], Path]:
        file = tmp_path / "rows.jsonl"
        before = len(read_rows(file))
        arguments = ["sweep.py", "--rows", str(file), "--only", "cube_of", "--factors", "3,10"]
        monkeypatch.setattr(sys, "argv", [*arguments, *more])
        assert sweep.main() == 0
        return [row["model"] for row in read_rows(file)[before:]], file

    return run


def test_a_sweep_goes_on_where_it_ended(swept) -> None:
    made, file = swept()
    assert len(made) == 2 * 18
    rows = file.read_text().splitlines(keepends=True)
    # The last line was being written when the machine went down.
    file.write_text("".join(rows[:-2]) + rows[-2][:40])
    made, _ = swept()
    assert len(made) == 2
    assert len({run_of(row) for row in read_rows(file)}) == 2 * 18
    assert swept()[0] == []


def test_two_runs_at_a_time_make_the_same_rows(swept) -> None:
    def what(row: dict) -> dict:
        return {key: value for key, value in row.items() if key not in TIMES}

    _, file = swept()
    one = {run_of(row): what(row) for row in read_rows(file)}
    file.unlink()
    made, _ = swept("--jobs", "3")
    assert len(made) == 2 * 18
    assert {run_of(row): what(row) for row in read_rows(file)} == one


def test_rows_are_added_whole(tmp_path: Path) -> None:
    file = tmp_path / "rows.jsonl"
    append_row(file, {"a": 1})
    with open(file, "a") as end:
        end.write('{"a": 2, "b')
    append_row(file, {"a": 3})
    assert read_rows(file) == [{"a": 1}, {"a": 3}]
