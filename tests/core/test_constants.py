# SPDX-License-Identifier: GPL-3.0-or-later
"""What the constants of the library say of themselves: unit, range, and what chose them; and that
they stand in the table of their room."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "native" / "src"
FILES = sorted(SOURCES.glob("*/constants.h"))
HEADINGS = re.findall(r"^#+ (.*)$", (ROOT / "docs" / "decisions.md").read_text(), re.MULTILINE)
LINE = re.compile(r"constexpr \w+ (k\w+) = ([^;]+);\s*// ([^;]+); ([^;]+); (.+)")
NUMBERS = {"pi": math.pi, "sqrt2": math.sqrt(2.0)}
ROOMS = sorted(path.name for path in SOURCES.iterdir() if path.is_dir())
NUMBER = re.compile(
    r"^( *)(?:inline |static )*constexpr (double|float|int|(?:std::)?(?:u?int\d+|size)_t)"
    r"((?:\s+k\w+ = [^;,]+,?)+);",
    re.MULTILINE,
)
# What may stand beside its code: a name for no element or no number, what follows from another
# constant, and how much is done at a time, which is counted in pieces. Inside of a function or a
# class whole numbers may as well.
NO_ELEMENT = re.compile(r"UINT32_MAX|-\d")
NO_NUMBER = re.compile(r"std::numeric_limits<\w+>::\w+\(\)|(?:\d \* )?k\w+")
UNKNOWN = ("kUnknown", "kAnywhere")
AT_A_TIME = re.compile(r"k\w+(?:PerPoll|PerBlock|Grain)|kPiecesPer\w+")
FIGURES = re.compile(r'\d|"\w+: ')  # numbers, or the subject of a commit that has them


def value_of(said: str, known: dict[str, float]) -> float:
    """A number, or a product such as "2 * std::numbers::pi / 3", of constants above it too."""
    said = re.sub(r"std::numbers::(\w+)", lambda name: str(NUMBERS[name[1]]), said)
    value, *factors = (
        word if word in "*/" else known[word] if word in known else number_of(word)
        for word in re.split(r" ([*/]) ", said)
    )
    for sign, factor in zip(factors[::2], factors[1::2], strict=True):
        value = value * factor if sign == "*" else value / factor
    return value


def number_of(word: str) -> float:
    return float.fromhex(word) if word.startswith("0x") else float(word)


def lies_within(value: float, said: str, known: dict[str, float]) -> bool:
    """A range is "> 0", ">= 1", "< 0" or "0 to pi", without its ends, which may be constants."""
    words = [word for word in said.split() if word not in {">", ">=", "<", "to"}]
    numbers = [known[word] if word in known else float(word) for word in words]
    if said.startswith(">="):
        return value >= numbers[0]
    if said.startswith(">"):
        return value > numbers[0]
    if said.startswith("<"):
        return value < numbers[0]
    low, high = numbers
    return low < value < high


def comment_above(lines: list[str], number: int) -> str:
    """What is said above the declarations that line `number` is one of."""
    said = []
    for line in reversed(lines[:number]):
        if line.startswith("///"):
            said.append(line)
        elif said or "constexpr" not in line:
            break
    return "\n".join(reversed(said))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.parent.name)
def test_each_constant_has_a_unit_a_range_and_a_source(path: Path) -> None:
    lines = path.read_text().splitlines()
    declared = [number for number, line in enumerate(lines) if "constexpr" in line]
    assert declared
    found = {number: LINE.search(lines[number]) for number in declared}
    assert not [lines[number] for number in declared if not found[number]]
    known = {"pi": math.pi}
    for line in found.values():
        known[line[1]] = value_of(line[2], known)
    for number, line in found.items():
        name, _value, _unit, said, source = line.groups()
        assert lies_within(known[name], said, known), lines[number]
        if source == "above":
            assert FIGURES.search(comment_above(lines, number)), lines[number]
        else:
            assert source in ("geometry", "free") or source.strip('"') in HEADINGS, lines[number]


def may_stand_beside_code(name: str, value: str, kind: str, *, inside: bool) -> bool:
    if NO_NUMBER.fullmatch(value) or name in UNKNOWN:
        return True
    if kind in ("double", "float"):
        return False
    return inside or bool(NO_ELEMENT.fullmatch(value) or AT_A_TIME.fullmatch(name))


def numbers_beside_code(text: str) -> list[str]:
    """Names of the numbers that a file declares and that belong into a table."""
    return [
        name
        for indent, kind, declared in NUMBER.findall(re.sub(r"//[^\n]*", "", text))
        for name, value in re.findall(r"(k\w+) = ([^,]+)", declared)
        if not may_stand_beside_code(name, value, kind, inside=bool(indent))
    ]


@pytest.mark.parametrize("room", ROOMS)
def test_numbers_stand_in_the_table_of_their_room(room: str) -> None:
    beside = {
        path.name: numbers_beside_code(path.read_text())
        for path in (SOURCES / room).iterdir()
        if path.name != "constants.h"
    }
    assert not {name: numbers for name, numbers in beside.items() if numbers}


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ("constexpr double kNear = 0.5;", ["kNear"]),
        ("inline constexpr uint32_t kFew = 3, kMany = 4;  // both", ["kFew", "kMany"]),
        ("constexpr double kNear = 1,\n                 kFar = 2;", ["kNear", "kFar"]),
        ("constexpr size_t kMost = size_t{1} << 30;", ["kMost"]),
        ("constexpr uint32_t kNobody = UINT32_MAX;\nconstexpr int32_t kNoFace = -1;", []),
        ("constexpr double kPull = -1;", ["kPull"]),
        ("constexpr uint32_t kPiecesPerPoll = 1u << 14;\nconstexpr size_t kPointGrain = 256;", []),
        ("// constexpr double kNear = 0.5;\n  constexpr double kHere = 0.5;", ["kHere"]),
        ("  static constexpr double kNear = 0.5, kFar = 2;", ["kNear", "kFar"]),
        ("  constexpr size_t kFaces = 16;\n  constexpr double kFar = 2 * kNear;", []),
        ("constexpr double kFar = std::numeric_limits<double>::infinity();", []),
        ("  static constexpr double kUnknown = -1;", []),
    ],
)
def test_numbers_beside_their_code_are_found(text: str, numbers: list[str]) -> None:
    assert numbers_beside_code(text) == numbers
