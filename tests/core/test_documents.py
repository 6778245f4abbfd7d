# SPDX-License-Identifier: GPL-3.0-or-later
"""The *.md files of the root and of docs name only what exists: links, files, tests and names of
the C interface. Comments in the library name only decisions that docs/decisions.md has.

What their commands do is for scripts/run_documents.py to say.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "native" / "src"
DOCUMENTS = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]
ROOMS = sorted(folder.name for folder in SOURCES.iterdir())

FENCE = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")
CODE = re.compile(r"`([^`\n]+)`")
# In a comment, and what chose a constant in the table of a room.
DECISION = re.compile(r'docs/decisions\.md(?:,|:)? "([^"]+)"|constexpr [^"]*; "([^"]+)"')
# `medial/frames`, `medial/frames.h` or `medial/frames.cpp`
SOURCE = re.compile(rf"(?:{'|'.join(ROOMS)})/\w+(?:\.h|\.cpp)?")
TEST = re.compile(r"(?:tests/\w+/)?test_\w+(?:\.py|\.cpp)?")
API = re.compile(r"\b(?:meander|MEANDER)_\w+\b")
# Not of the header: the benchmark, a job type, what is installed, and variables of the environment.
OTHERS = re.compile(r"meander_(?:bench|core|fill|installed)|MEANDER_(?:LIBRARY|PYTHON313)")
CMAKE_FILES = [ROOT / "CMakeLists.txt", *sorted((ROOT / "cmake").rglob("*.cmake"))]
CMAKE_OPTION = re.compile(r"^\s*(?:option|set|find_program)\((MEANDER_\w+) ", re.MULTILINE)
OPTIONS = {
    name for path in CMAKE_FILES for name in CMAKE_OPTION.findall(path.read_text(encoding="utf-8"))
}


def is_source(name: str) -> bool:
    suffixes = [""] if "." in name else [".h", ".cpp"]
    return any((SOURCES / (name + suffix)).is_file() for suffix in suffixes)


def is_test(name: str) -> bool:
    if "/" in name:
        return (ROOT / name).is_file()
    pattern = name if "." in name else f"{name}.*"
    return any((ROOT / "tests").glob(f"*/{pattern}"))


def is_declared(name: str, header: str) -> bool:
    # A name that ends in an underscore stands for all that begin with it.
    return re.search(rf"\b{name}" + ("" if name.endswith("_") else r"\b"), header) is not None


def wrong_names(text: str, folder: Path, header: str) -> list[str]:
    """What a document names that does not exist; its links are relative to `folder`."""
    wrong = [target for target in LINK.findall(text) if not (folder / target).exists()]
    for code in CODE.findall(FENCE.sub("", text)):
        if SOURCE.fullmatch(code):
            wrong += [] if is_source(code) else [code]
        elif TEST.fullmatch(code):
            wrong += [] if is_test(code) else [code]
        else:
            wrong += [
                name for name in API.findall(code)
                if not (name in OPTIONS or OTHERS.fullmatch(name) or is_declared(name, header))
            ]
    return wrong


@pytest.fixture(scope="module")
def header() -> str:
    folder = ROOT / "native" / "include" / "meander"
    return "\n".join(path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.h")))


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_a_document_names_only_what_exists(document, header):
    text = document.read_text(encoding="utf-8")
    assert wrong_names(text, document.parent, header) == []


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("[x](quality.md) [y](nowhere.md)", "nowhere.md"),
        ("`medial/frames` `medial/frames.h` `medial/fames`", "medial/fames"),
        ("`curve/curve.cpp` `curve/frames.cpp`", "curve/frames.cpp"),
        ("`test_flow` `tests/core/test_documents.py` `test_flows`", "test_flows"),
        ("`meander_flow_step(flow)` `meander_flow_stop(flow)`", "meander_flow_stop"),
        ("`MEANDER_WERROR` `-DMEANDER_UNITY=ON` `MEANDER_UNIT`", "MEANDER_UNIT"),
        ("`MEANDER_PRESET_` `MEANDER_PRESET_EVEN` `MEANDER_PRESET_ODD`", "MEANDER_PRESET_ODD"),
    ],
)
def test_a_wrong_name_is_found(text, wrong, header):
    assert wrong_names(text, ROOT / "docs", header) == [wrong]


def decisions_named(source: str) -> list[str]:
    """The headings of docs/decisions.md that comments name, also where a name is broken in two."""
    found = DECISION.findall(re.sub(r"\s*\n\s*///?\s*", " ", source))
    return [in_comment or in_table for in_comment, in_table in found]


def test_comments_name_decisions_that_are_there():
    page = (ROOT / "docs" / "decisions.md").read_text(encoding="utf-8")
    headings = set(re.findall(r"^### (.+)$", page, re.MULTILINE))
    sources = [path.read_text(encoding="utf-8") for path in SOURCES.rglob("*.[ch]*")]
    named = {name for text in sources for name in decisions_named(text)}
    assert len(named) > 10
    assert named - headings == set()


def test_a_decision_is_found_in_a_broken_comment():
    source = '/// 3 (docs/decisions.md, "Wide\n/// loops"), and 4: docs/decisions.md,\n/// "Necks".'
    assert decisions_named(source) == ["Wide loops", "Necks"]
    table = 'constexpr double kA = 3;  // r; > 0; "Necks"\nconstexpr double kB = 1;  // r; free'
    assert decisions_named(table) == ["Necks"]
