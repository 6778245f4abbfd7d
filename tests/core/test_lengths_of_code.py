# SPDX-License-Identifier: GPL-3.0-or-later
"""No function is longer than 60 lines, and no file than 400, but what is generated."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PYTHON = [path for name in ("addon", "python", "scripts") for path in (ROOT / name).rglob("*.py")]
NATIVE = [path for path in (ROOT / "native" / "src").rglob("*.*") if path.suffix in {".h", ".cpp"}]
GENERATED = {ROOT / "addon" / "meander" / "binding" / "abi.py"}
# What says nothing of blocks, and what a block is whose own blocks are functions.
NO_CODE = re.compile(
    r"""//.*|^ *#(?:.*\\\n)*.*|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+'""", re.MULTILINE
)
SCOPE = re.compile(r"\b(?:namespace|class|struct)\b[^()]*$")


def functions_of_python(text: str) -> Iterator[tuple[str, int]]:
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            yield node.name, node.end_lineno - node.lineno + 1


def functions_of_native(text: str) -> Iterator[tuple[str, int]]:
    code = NO_CODE.sub("", text)
    blocks: list[tuple[str, int]] = []  # those that are open: what stands before each, and where
    begin = 0
    for brace in re.finditer("[{};]", code):
        head, begin = code[begin : brace.start()].strip(), brace.end()
        if brace[0] == "{":
            blocks.append((head, brace.start()))
        elif brace[0] == "}":
            head, opened = blocks.pop()
            if "(" in head and all(SCOPE.search(outer) for outer, _opened in blocks):
                yield head, (head + code[opened : brace.end()]).count("\n") + 1


def too_long(text: str, kind: str) -> list[str]:
    functions = functions_of_python if kind == ".py" else functions_of_native
    found = [f"{name} has {count} lines" for name, count in functions(text) if count > 60]
    count = len(text.splitlines())
    return found + ([f"it has {count} lines"] if count > 400 else [])


@pytest.mark.parametrize("paths", [PYTHON, NATIVE], ids=["python", "native"])
def test_functions_and_files_are_short(paths: list[Path]) -> None:
    found = {path: too_long(path.read_text("utf-8"), path.suffix) for path in paths}
    assert {path: said for path, said in found.items() if said and path not in GENERATED} == {}


@pytest.mark.parametrize(
    ("kind", "head", "tail"),
    [
        (".py", "def f():", "    return"),
        (".cpp", "int f(\n    int a) {", "}"),
        (".h", "class A {\n  A(int a)\n      : a_(a) {", "  }\n};"),
    ],
)
def test_what_is_too_long_is_found(kind: str, head: str, tail: str) -> None:
    body = "\n".join([head, *["    a();"] * 60, tail])
    (said,) = too_long(body, kind)
    assert " lines" in said and too_long(body.replace("    a();\n", "", 8), kind) == []
    assert too_long(body + 340 * "\n\n", kind)[-1].startswith("it has ")
