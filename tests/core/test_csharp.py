# SPDX-License-Identifier: GPL-3.0-or-later
"""The declarations for C#: those of the header, as C# lays them out, and an example that runs."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from meander import core

ROOT = Path(__file__).resolve().parents[2]
CSHARP = ROOT / "native" / "csharp"

# Every struct of the header by reflection: its size, and where its fields are.
LAYOUTS = """
using System;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
static class Layouts
{
    static void Main()
    {
        foreach (Type type in typeof(Meander.Api).Assembly.GetTypes().Where(
            t => t.Namespace == "Meander" && t.IsClass && t.IsLayoutSequential))
        {
            var names = type.GetFields().Select(field => field.Name);
            var offsets = string.Join(" ", names.Select(name => Marshal.OffsetOf(type, name)));
            Console.WriteLine(type.Name + " " + Marshal.SizeOf(type) + " " + offsets);
        }
    }
}
"""


def test_the_declarations_are_those_of_the_header() -> None:
    script = ROOT / "scripts" / "write_csharp.py"
    done = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def run(folder: Path, *sources: Path) -> str:
    """Compiles and runs a program. Debian's Mono stands for .NET, of which Rhino has both."""
    if shutil.which("mcs") is None:
        pytest.skip("mono-mcs is not there; scripts/test.sh --all installs it")
    program = folder / "program.exe"
    command = ["mcs", "-langversion:6", "-warnaserror", f"-out:{program}", *map(str, sources)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    shutil.copy(core.library_path(), folder / "libmeander.so")
    done = subprocess.run(
        ["mono", str(program)],
        capture_output=True,
        text=True,
        env={"LD_LIBRARY_PATH": str(folder), "PATH": "/usr/bin:/bin", "HOME": str(folder)},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_structs_are_laid_out_as_the_library_has_them(tmp_path: Path) -> None:
    source = tmp_path / "Layouts.cs"
    source.write_text(LAYOUTS)
    rows = [line.split() for line in run(tmp_path, source, CSHARP / "Meander.cs").splitlines()]
    found = {
        "meander_" + re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower(): tuple(map(int, numbers))
        for name, *numbers in rows
    }
    assert found == {name: tuple(theirs) for name, (_, theirs) in core.struct_layouts().items()}


def test_the_example_fills_an_octahedron(tmp_path: Path) -> None:
    said = run(tmp_path, CSHARP / "Example.cs", CSHARP / "Meander.cs")
    assert re.fullmatch(r"1[0-9]{3} points, 1 strand\n", said)
