# SPDX-License-Identifier: GPL-3.0-or-later
"""What GCC takes and Clang 14 does not, which compiles what nightly suites sanitize."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("native/src", "native/bench", "tests/native", "tests/fuzz")

# It cannot read the subranges and views of libstdc++ 12; these make one.
SUBRANGES = re.compile(
    r"std::ranges::(?:unique|remove|remove_if|partition|stable_partition|rotate|equal_range|search|"
    r"search_n|find_end|subrange)\b|std::ranges::(?:min|max|minmax)\(\{|std::(?:ranges::)?views::"
)
CONSTANT = re.compile(r"^( *)(?:static )?constexpr [\w:<>]+ (k[A-Z]\w*)\b", re.MULTILINE)


def hidden_constants(text: str) -> list[str]:
    """Those within a function that hide one of the file, of which Clang warns."""
    constants = CONSTANT.findall(text)
    of_file = {name for indent, name in constants if not indent}
    return [name for indent, name in constants if indent and name in of_file]


def test_clang_reads_the_sources():
    found = []
    for folder in FOLDERS:
        for file in sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in {".h", ".cpp"}):
            text = file.read_text(encoding="utf-8")
            what = SUBRANGES.findall(text) + hidden_constants(text)
            found += [f"{file.relative_to(ROOT)}: {name}" for name in what]
    assert found == []


@pytest.mark.parametrize(
    "code",
    [
        "found.erase(std::ranges::unique(found).begin(), found.end());",
        "const uint32_t k = std::ranges::min({0u, 1u, 2u}, {}, rank);",
        "for (uint32_t v : std::views::iota(0u, count)) visit(v);",
    ],
)
def test_a_subrange_is_found(code):
    assert SUBRANGES.findall(code)


def test_a_hidden_constant_is_found():
    text = "constexpr double kShare = 0.5;\nvoid f() {\n  constexpr double kShare = 0.25;\n}\n"
    assert hidden_constants(text) == ["kShare"]
