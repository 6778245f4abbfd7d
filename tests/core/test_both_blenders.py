# SPDX-License-Identifier: GPL-3.0-or-later
"""Which tests the gate runs in both versions of Blender (tests/blender/calls.py)."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

spec = importlib.util.spec_from_file_location("calls", ROOT / "tests/blender/calls.py")
calls = importlib.util.module_from_spec(spec)
spec.loader.exec_module(calls)


def test_enough_tests_call_every_function():
    of_tests = {
        "one": ["a", "b"],
        "the same": ["a", "b"],
        "more": ["a", "b", "c"],
        "other": ["d"],
        "none": [],
        "last": ["c", "e"],
    }
    chosen = calls.enough(of_tests)
    assert chosen == {"more", "other", "last"}
    assert set().union(*(of_tests[test] for test in chosen)) == set().union(*of_tests.values())


def test_what_is_called_is_known_by_the_file_that_it_is_in(tmp_path):
    (tmp_path / "scene").mkdir()
    (tmp_path / "scene" / "drawn.py").write_text(
        "def outer():\n    def inner():\n        pass\n    inner()\n\n\ndef idle():\n    pass\n\n\n"
        "def never():\n    import bpy\n"
    )
    (tmp_path / "pure.py").write_text("def compute():\n    pass\n")
    modules = {}
    for file in ("scene/drawn.py", "pure.py"):
        code = compile((tmp_path / file).read_text(), str(tmp_path / file), "exec")
        exec(code, modules)
    with calls.called() as seen:
        modules["outer"]()
        modules["compute"]()
        subprocess.run([sys.executable, "-c", ""], check=True)
    modules["idle"]()
    assert calls.of_blender(seen, tmp_path, "test_x.py::test_y[1]") == [
        "scene/drawn.py outer", "scene/drawn.py outer.<locals>.inner", "test_x.py starts programs",
    ]


def test_notes_are_read_as_they_were_written(tmp_path):
    file = tmp_path / "calls.json"
    assert calls.read(file) == {}
    calls.write(file, {"b": ["x"], "a": []})
    assert list(calls.read(file).items()) == [("b", ["x"]), ("a", [])]
