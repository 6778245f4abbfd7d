# SPDX-License-Identifier: GPL-3.0-or-later
"""A file is about one idea, and a function does one thing: neither is long."""

from __future__ import annotations

import ast
import re
import subprocess
from pathlib import Path

import pytest
from conftest import REPOSITORY

LONGEST_FILE, LONGEST_FUNCTION = 400, 60

PYTHON = ("addon", "python", "scripts", "benchmarks")
CONTROL = re.compile(r"^\s*(?:if|for|while|switch|else|do|catch|try|namespace|class|struct|enum)\b")


def files(*folders: str) -> list[Path]:
    """What of them is under version control: all but what a build makes."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", *folders], cwd=REPOSITORY, capture_output=True, check=True
    ).stdout.decode()
    paths = [REPOSITORY / name for name in listed.split("\0") if name]
    return [path for path in paths if path.suffix in (".py", ".cpp", ".h") and path.is_file()]


def functions_of_python(text: str) -> dict[str, int]:
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    nodes = [node for node in ast.walk(ast.parse(text)) if isinstance(node, kinds)]
    return {node.name: node.end_lineno - node.lineno + 1 for node in nodes}


def functions_of_cpp(text: str) -> dict[str, int]:
    """The bodies that no other is around, by what stands before them."""
    text = re.sub(r"^\s*#.*", "", text, flags=re.MULTILINE)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/|\'(?:\\.|[^\'\\\n])\'',
                  lambda found: "\n" * found[0].count("\n"), text, flags=re.DOTALL)  # fmt: skip
    found: dict[str, int] = {}
    open_: list[tuple[str, int]] = []  # the name of a function, or "", and where it begins
    begin = 0  # of what stands before the next brace
    for at, character in ((m.start(), m[0]) for m in re.finditer("[{};]", text)):
        if character == "{":
            head = text[begin:at].strip()
            inside = any(name for name, _ in open_)
            is_function = ")" in head and not CONTROL.match(head) and not inside
            open_.append((head if is_function else "", at - len(text[begin:at].lstrip())))
        elif character == "}":
            name, first = open_.pop()
            if name:
                found[name.splitlines()[0]] = text[first:at].count("\n") + 1
        begin = at + 1
    return found


def too_long(path: Path) -> list[str]:
    text = path.read_text(encoding="utf-8")
    name = path.relative_to(REPOSITORY).as_posix()
    functions = functions_of_python(text) if path.suffix == ".py" else functions_of_cpp(text)
    wrong = [f"{name}: {n} lines of {f}" for f, n in functions.items() if n > LONGEST_FUNCTION]
    lines = text.count("\n")
    return wrong + ([f"{name}: {lines} lines"] if lines > LONGEST_FILE else [])


def test_no_file_and_no_function_is_long() -> None:
    paths = files("native/src", *PYTHON)
    assert len(paths) > 500
    assert [line for path in paths for line in too_long(path)] == []


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("int f(int a) {\n  return a;\n}\n", 3),
        ("A::A(int a)\n    : a_{a},\n      b_(a) {\n  b();\n}\n", 4),
        ("struct S {\n  int f() const {\n    if (a) {\n    }\n    return 1;\n  }\n};\n", 5),
        ('void f() {\n  g("{", \'{\');  // {\n}\n', 3),
        ("template <class T>\nvoid f(\n    T a) {\n  [&](int) {\n  }();\n}\n", 6),
    ],
)
def test_functions_are_measured(text: str, lines: int) -> None:
    assert max(functions_of_cpp(text).values()) == lines
