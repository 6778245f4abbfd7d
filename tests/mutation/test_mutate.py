# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool for mutation testing, on a toy whose killed and surviving mutants are known."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from mutate import failure
from schemata import Mutant, Schemata

HERE = Path(__file__).resolve().parent
FUNCTIONS = ["overlap", "sum", "far"]
# What no test of the toy could notice: its comments say why.
SURVIVORS = {
    ("low < high", "< -> <="),  # what has no length overlaps by nothing as well
    ("last = 0", "0 -> 1"),
    ("last = k", "last = k -> removed"),
    ("k = 1", "1 -> 0"),
    ("std::abs(-x", "- -> +"),
    ("d / 1.0", "/ -> *"),
}


@pytest.fixture(scope="module")
def toy(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Path, list[Mutant], str]]:
    folder = tmp_path_factory.mktemp("toy")
    schemata = Schemata(HERE / "toy.cpp", ["-std=c++20"], FUNCTIONS)
    (folder / "toy.cpp").write_text(schemata.mutated)
    command = ["g++", "-std=c++20", "-O0", f"-I{HERE}", "toy.cpp", "-o", "toy"]
    subprocess.run(command, cwd=folder, check=True)
    yield folder / "toy", schemata.mutants, schemata.mutated


def test_operators_of_every_kind_become_mutants(toy: tuple[Path, list[Mutant], str]) -> None:
    _, mutants, mutated = toy
    changes = {(m.function, m.was, m.becomes) for m in mutants}
    assert {
        ("overlap", "!", ""),
        ("overlap", "<", "<="),
        ("overlap", "<", ">="),
        ("overlap", "||", "left"),
        ("overlap", "||", "right"),
        ("overlap", "condition", "never"),
        ("overlap", "min", "max"),
        ("overlap", "-", "+"),
        ("sum", "%", "left"),
        ("sum", "==", "!="),
        ("sum", "+=", "-="),
        ("sum", "1", "0"),
        ("far", "*", "/"),
        ("far", "abs", "itself"),
        ("far", "condition", "never"),
        ("far", "condition", "always"),
    } <= changes
    assert not any(m.was == "0.5" for m in mutants)
    # What the compiler says of the mutated source is where it was.
    written = (HERE / "toy.cpp").read_text().splitlines()
    assert len(mutated.splitlines()) == len(written) + 2


def test_the_right_ones_survive(toy: tuple[Path, list[Mutant], str]) -> None:
    program, mutants, _ = toy
    assert failure(program, [], 0, 0.0) is None
    alive = [m for m in mutants if failure(program, [], m.number, 0.0) is None]
    known = {
        next(
            (s for s in SURVIVORS if s[0] in m.text and s[1] == f"{m.was} -> {m.becomes}"), m.number
        )
        for m in alive
    }
    assert known == SURVIVORS
    assert len(alive) == len(SURVIVORS) < len(mutants) / 4


def test_what_never_ends_is_killed(tmp_path: Path) -> None:
    source = "int main() { volatile int n = 0; while (n == 0) { } }"
    subprocess.run(
        ["g++", "-xc++", "-", "-o", tmp_path / "endless"], input=source.encode(), check=True
    )
    assert failure(tmp_path / "endless", [], 0, 0.0) == "time"


def test_a_function_that_is_missing_is_told() -> None:
    with pytest.raises(ValueError, match="has no function absent"):
        Schemata(HERE / "toy.cpp", ["-std=c++20"], ["sum", "absent"])
