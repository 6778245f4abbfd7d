# SPDX-License-Identifier: GPL-3.0-or-later
"""What the constants of the library say of themselves: unit, range, and what chose them."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FILES = sorted((ROOT / "native" / "src").glob("*/constants.h"))
TABLES = [path for path in FILES if path.parent.name in {"medial", "outputs"}]
HEADINGS = re.findall(r"^#+ (.*)$", (ROOT / "docs" / "decisions.md").read_text(), re.MULTILINE)
LINE = re.compile(r"constexpr \w+ (k\w+) = ([^;]+);\s*// ([^;]+); ([^;]+); (.+)")


def lies_within(value: float, said: str) -> bool:
    """A range is "> 0", ">= 1" or "0 to pi", without its ends."""
    words = said.replace("pi", str(math.pi)).split()
    numbers = [float(word) for word in words if word[-1].isdigit()]
    if said.startswith(">="):
        return value >= numbers[0]
    if said.startswith(">"):
        return value > numbers[0]
    low, high = numbers
    return low < value < high


@pytest.mark.parametrize("path", TABLES, ids=lambda path: path.parent.name)
def test_each_constant_has_a_unit_a_range_and_a_source(path: Path) -> None:
    declared = [line for line in path.read_text().splitlines() if "constexpr" in line]
    assert declared
    for line in declared:
        found = LINE.search(line)
        assert found, line
        _name, value, _unit, said, source = found.groups()
        assert lies_within(float(value), said), line
        assert source in ("geometry", "free") or source.strip('"') in HEADINGS, line


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.parent.name)
def test_the_headings_that_constants_name_are_there(path: Path) -> None:
    text = re.sub(r"\s*\n\s*//+ ?", " ", path.read_text())
    for heading in re.findall(r'docs/decisions\.md,? "([^"]*)"', text):
        assert heading in HEADINGS
