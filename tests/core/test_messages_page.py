# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/messages.md quotes only what the add-on and the library say."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "messages.md"

QUOTE = re.compile(r'"([^"]+)"')
# Literals that stand behind one another are one.
LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
# A value in the middle of a message; no quotation spans it.
VALUE = "\0"


def joined(node: ast.expr) -> str:
    """The text of a literal or an f-string."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(
            joined(part) if isinstance(part, ast.Constant) else VALUE for part in node.values
        )
    return ""


def python_texts() -> Iterator[str]:
    for path in (ROOT / "addon").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant | ast.JoinedStr):
                yield joined(node)


def native_texts() -> Iterator[str]:
    for path in (ROOT / "native" / "src").rglob("*.cpp"):
        for literals in LITERALS.findall(path.read_text(encoding="utf-8")):
            yield "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', literals))


@pytest.fixture(scope="module")
def everything() -> str:
    return VALUE.join([*python_texts(), *native_texts()])


def unknown_quotes(text: str, everything: str) -> list[str]:
    return [quote for quote in QUOTE.findall(text) if quote not in everything]


def test_the_page_quotes_what_is_said(everything):
    text = PAGE.read_text(encoding="utf-8")
    assert len(QUOTE.findall(text)) > 20
    assert unknown_quotes(text, everything) == []


def test_a_quotation_of_nothing_is_found(everything):
    assert unknown_quotes('| "The cat is on the mesh" |', everything) == ["The cat is on the mesh"]
