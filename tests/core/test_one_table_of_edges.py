# SPDX-License-Identifier: GPL-3.0-or-later
"""One table of a soup's edges: nothing else in the room of meshes puts half-edges into groups."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

MESH = Path(__file__).resolve().parents[2] / "native" / "src" / "mesh"
THE_TABLE = "edge_groups.h"

# What every table of edges has to do: to give an edge the same name from both its faces. A lower
# and a higher end of the same two, in one number or one after the other; or a list of edges with
# what lies at each, to be sorted.
NAMES_AN_EDGE = (
    re.compile(r"std::min\((\w+), (\w+)\)(?:(?!\n\n)[\s\S]){0,600}?std::max\((?:\1, \2|\2, \1)\)"),
    re.compile(r"std::minmax\("),
    re.compile(r"<< 32"),
    re.compile(r"\b(?:pair|tuple)<\s*(?:VertexPair|std::array<uint32_t, 2>)\s*,"),
    re.compile(r"struct \w+ \{\s*VertexPair edge\b"),
)


def second_tables(mesh: Path) -> list[str]:
    """One line for every place that names edges for a table of its own."""
    found = []
    sources = (p for p in mesh.iterdir() if p.suffix in {".h", ".cpp"} and p.name != THE_TABLE)
    for file in sorted(sources):
        text = file.read_text(encoding="utf-8")
        for pattern in NAMES_AN_EDGE:
            hits = (" ".join(hit[0].split())[:60] for hit in pattern.finditer(text))
            found += [f"{file.name}: {hit}" for hit in hits]
    return found


def test_edges_are_named_in_their_table_only():
    assert second_tables(MESH) == []


@pytest.mark.parametrize(
    "user", ["mesh_check.cpp", "sheets.cpp", "seams.cpp", "empty_faces.cpp", "fans.cpp"]
)
def test_what_asks_for_edges_asks_the_table(user):
    text = (MESH / user).read_text(encoding="utf-8")
    assert re.search(r"\bEdgeGroups\b|\bedges\(\)|\bedges_->", text)


@pytest.mark.parametrize(
    "code",
    [
        "uint64_t key(uint32_t a, uint32_t b) "
        "{ return (uint64_t{std::min(a, b)} << 32) | std::max(a, b); }",
        "const uint32_t low = std::min(a, b);\nput(low, Side{std::max(a, b), e});",
        "sides.emplace_back(VertexPair{std::min(a, b), std::max(b, a)}, e);",
        "std::vector<std::pair<VertexPair, uint32_t>> sides;",
        "struct SideOfPart {\n  VertexPair edge, fans;\n};",
        "const auto [low, high] = std::minmax(a, b);",
    ],
)
def test_a_second_table_is_found(tmp_path, code):
    (tmp_path / "sheets.cpp").write_text(code, encoding="utf-8")
    assert second_tables(tmp_path)
