# SPDX-License-Identifier: GPL-3.0-or-later
"""What the constants of the library say of themselves: unit, range, and what chose them."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FILES = sorted((ROOT / "native" / "src").glob("*/constants.h"))
HEADINGS = re.findall(r"^#+ (.*)$", (ROOT / "docs" / "decisions.md").read_text(), re.MULTILINE)
LINE = re.compile(r"constexpr \w+ (k\w+) = ([^;]+);\s*// ([^;]+); ([^;]+); (.+)")
NUMBERS = {"pi": math.pi, "sqrt2": math.sqrt(2.0)}
FIGURES = re.compile(r'\d|"\w+: ')  # numbers, or the subject of a commit that has them


def value_of(said: str) -> float:
    """A number, or a product such as "2 * std::numbers::pi / 3"."""
    said = re.sub(r"std::numbers::(\w+)", lambda name: str(NUMBERS[name[1]]), said)
    value, *factors = re.split(r" ([*/]) ", said)
    result = float(value)
    for sign, factor in zip(factors[::2], factors[1::2], strict=True):
        result = result * float(factor) if sign == "*" else result / float(factor)
    return result


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
    known = {"pi": math.pi, **{line[1]: value_of(line[2]) for line in found.values()}}
    for number, line in found.items():
        name, _value, _unit, said, source = line.groups()
        assert lies_within(known[name], said, known), lines[number]
        if source == "above":
            assert FIGURES.search(comment_above(lines, number)), lines[number]
        else:
            assert source in ("geometry", "free") or source.strip('"') in HEADINGS, lines[number]
