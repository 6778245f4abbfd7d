#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""test_shrink.py FUZZ_API COMPILER...: a fault that is planted becomes a test of two calls.

Run by ctest where fuzz_api is built. The fault is that gaps are asked for after another radius
(MEANDER_FUZZ_PLANTED in tests/fuzz/fuzz_api.cpp). What is written has to be C++: the compiler looks
at it, and compiles nothing.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent


def operations() -> dict[str, int]:
    """The names of tests/fuzz/record.h and what they are in bytes."""
    text = (HERE / "record.h").read_text(encoding="utf-8").partition("enum Op")[2]
    names = re.findall(r"^  (k\w+)", text.partition("};")[0], re.MULTILINE)
    return {name: number for number, name in enumerate(names)}


def main() -> None:
    program, compiler = sys.argv[1], sys.argv[2:]
    code = operations()
    scenario = ["kShape", "kSurfaceCreate", "kFlowCreate", "kStep", "kSetRadius", "kPolylines",
                "kFindFaults", "kGaps", "kCut", "kStep"]  # fmt: skip
    records = [bytes([code[name], 0, 3, 1, 2, 3, 4, 0]) for name in scenario]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        crash, shrunk, test = folder / "crash", folder / "shrunk", folder / "test.cpp"
        crash.write_bytes(b"".join(records) + b"rest")
        command = [sys.executable, str(HERE / "shrink.py"), program, str(crash)]
        command += ["--output", str(shrunk), "--test", str(test)]
        sound = subprocess.run(command, capture_output=True, text=True)
        assert sound.returncode != 0 and "nothing fails" in sound.stderr, sound.stderr
        subprocess.run(command, check=True, env=os.environ | {"MEANDER_FUZZ_PLANTED": "1"})
        left = shrunk.read_bytes()
        assert left == b"".join(bytes([code[n]]) + bytes(7) for n in ("kSetRadius", "kGaps")), left
        text = test.read_text(encoding="utf-8")
        calls = re.findall(r"status = (meander_\w+)\(", text)
        assert calls == ["meander_flow_set_radius", "meander_flow_find_gaps"], calls
        assert "a fault that was planted" in text
        # With its includes as from tests/native, where it belongs.
        subprocess.run([*compiler, "-std=c++20", "-fsyntax-only", "-Werror", "-Wall", f"-I{HERE}",
                        f"-I{HERE.parent / 'native'}", f"-I{HERE.parents[1] / 'native/include'}",
                        str(test)], check=True)  # fmt: skip


if __name__ == "__main__":
    main()
