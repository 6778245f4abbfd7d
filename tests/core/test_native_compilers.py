# SPDX-License-Identifier: GPL-3.0-or-later
"""What GCC takes and Clang 14 does not, which compiles what nightly suites sanitize."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("native/src", "native/bench", "tests/native", "tests/fuzz", "tests/sweep")

# It cannot read the subranges and views of libstdc++ 12; these make one.
SUBRANGES = re.compile(
    r"std::ranges::(?:unique|remove|remove_if|partition|stable_partition|rotate|equal_range|search|"
    r"search_n|find_end|subrange)\b|std::ranges::(?:min|max|minmax)\(\{|std::(?:ranges::)?views::"
)
# It has no lambda that captures one of several names that are declared at once.
BINDINGS = re.compile(r"\bauto&{0,2} \[([\w, ]+)\]")
LAMBDA = re.compile(r"\[([&=][^\]]*)\] ?(?:\([^()]*(?:\([^()]*\)[^()]*)*\))?[^{};]*\{")
CONSTANT = re.compile(r"^( *)(?:static )?constexpr [\w:<>]+ (k[A-Z]\w*)\b", re.MULTILINE)


def hidden_constants(text: str) -> list[str]:
    """Those within a function that hide one of the file, of which Clang warns."""
    constants = CONSTANT.findall(text)
    of_file = {name for indent, name in constants if not indent}
    return [name for indent, name in constants if indent and name in of_file]


def end_of_block(text: str, begin: int) -> int:
    """Where the block ends that `begin` is in."""
    depth = 0
    for place in range(begin, len(text)):
        depth += {"{": 1, "}": -1}.get(text[place], 0)
        if depth < 0:
            return place
    return len(text)


def captured_bindings(text: str) -> list[str]:
    text = re.sub(r"//.*", "", text)
    found = []
    for bindings in BINDINGS.finditer(text):
        # Of a loop, its body.
        loop = re.match(r" :[^;{}]*\{", text[bindings.end() :])
        begin = bindings.end() + (loop.end() if loop else 0)
        block = text[begin : end_of_block(text, begin)]
        for taken in LAMBDA.finditer(block):
            body = block[taken.end() : end_of_block(block, taken.end())]
            for name in bindings[1].split(", "):
                named_anew = re.search(rf"\b{name} =", taken[1])
                if not named_anew and re.search(rf"(?<![.>]){name}\b", body):
                    found.append(name)
    return found


def test_clang_reads_the_sources():
    found = []
    for folder in FOLDERS:
        for file in sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in {".h", ".cpp"}):
            text = file.read_text(encoding="utf-8")
            what = SUBRANGES.findall(text) + hidden_constants(text) + captured_bindings(text)
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


def test_a_captured_binding_is_found():
    text = "void f() {{ const auto [a, b] = g(); const auto h = [{}](int x) {{ return x + a; }}; }}"
    assert captured_bindings(text.format("&")) == ["a"]
    assert captured_bindings(text.format("&, a = a")) == []
    loop = "for (const auto& [a, b] : all) { visit([&] { use(b); }); } sort([&] { return a; });"
    assert captured_bindings(loop) == ["b"]
