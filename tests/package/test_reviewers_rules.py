# SPDX-License-Identifier: GPL-3.0-or-later
"""What the reviewers of Blender's extension site look for, and its validator does not."""

from __future__ import annotations

import ast
import zipfile
from pathlib import Path

import pytest

# Neither the network, nor other programs, nor code from elsewhere.
FORBIDDEN = {"urllib", "http", "socket", "ssl", "requests", "subprocess", "pip", "ensurepip",
             "runpy", "pickle", "marshal"}  # fmt: skip
CALLS = {"eval", "exec", "compile", "__import__"}
# Commands start by themselves, outside of any package, and find the add-on that they lie in.
COMMANDS = {"meander/batch.py", "meander/camera.py", "meander/farm.py"}
# What fills many files is a program that starts Blender; Blender never loads it.
PROGRAM = "meander/jobs/"


@pytest.fixture(scope="module")
def modules(addon_zip: Path) -> dict[str, ast.Module]:
    with zipfile.ZipFile(addon_zip) as archive:
        names = [name for name in archive.namelist() if name.endswith(".py")]
        return {name: ast.parse(archive.read(name), name) for name in names}


def imported(tree: ast.Module) -> set[str]:
    """The first names of all absolute imports, wherever they stand."""
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            found.add(node.module.split(".")[0])
    return found


def breaches(name: str, tree: ast.Module) -> list[str]:
    """What a reviewer would ask about, a line each."""
    found = [f"{name} imports {module}" for module in imported(tree) & FORBIDDEN]
    if name in COMMANDS or name.startswith(PROGRAM):
        found = []
    elif "meander" in imported(tree):
        found.append(f"{name} imports its own package by name")
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in CALLS:
            found.append(f"{name}:{node.lineno} calls {node.func.id}")
        if name in COMMANDS or not isinstance(node, ast.Attribute) or node.attr != "path":
            continue
        if isinstance(node.value, ast.Name) and node.value.id == "sys":
            found.append(f"{name}:{node.lineno} uses sys.path")
    return found


def test_nothing_that_reviewers_ask_about(modules: dict[str, ast.Module]) -> None:
    assert len(modules) > 100
    assert [line for name, tree in modules.items() for line in breaches(name, tree)] == []


def test_the_add_on_does_not_load_the_program(modules: dict[str, ast.Module]) -> None:
    loading = {
        name
        for name, tree in modules.items()
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and "jobs" in (node.module or "").split(".")
    }
    assert {name for name in loading if not name.startswith(PROGRAM)} <= COMMANDS


@pytest.mark.parametrize(
    "source",
    ["import urllib.request", "def late():\n    from subprocess import run", "import meander",
     "eval('1')", "import sys\nsys.path.append('x')"],
)  # fmt: skip
def test_the_rule_bites(source: str) -> None:
    assert breaches("meander/ui/panels.py", ast.parse(source))
