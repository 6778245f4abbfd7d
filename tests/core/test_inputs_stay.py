# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run reads is never what it writes, whatever option names it."""

from __future__ import annotations

import os
from pathlib import Path

import geometry
import pytest
from meander import batch
from meander.cli import arguments
from sentences import assert_sentence

CURVE = "v 0.1 0.5 0\nv 0.9 0.5 0\nl 1 2\n"


@pytest.fixture
def files(tmp_path: Path) -> dict[str, Path]:
    """A file for every option that reads one."""
    found = {"input": geometry.write_obj(tmp_path / "input.obj", geometry.grid(6))}
    for name in arguments.read_options()[1:]:
        curve = name in ("seed", "guides")
        found[name] = tmp_path / (f"{name}.obj" if curve else f"{name}.gcode")
        found[name].write_text(CURVE if curve else "; of mine\n")
    return found


def test_the_options_that_read_files() -> None:
    assert arguments.read_options() == ("input", "seed", "guides", "header", "footer")


@pytest.mark.parametrize("way", ["itself", "another spelling", "a link", "a hard link"])
@pytest.mark.parametrize("option", ["output", "report"])
@pytest.mark.parametrize("read", ["seed", "guides", "header", "footer"])
def test_none_is_overwritten(
    files: dict[str, Path], read: str, option: str, way: str, capsys: pytest.CaptureFixture
) -> None:
    victim = files[read]
    before = victim.read_bytes()
    named = victim
    if way == "another spelling":
        named = victim.parent / "." / ".." / victim.parent.name / victim.name
    elif way != "itself":
        named = victim.with_name(f"link{victim.suffix}")
        (os.symlink if way == "a link" else os.link)(victim, named)
    given = {
        "output": victim.with_name(f"out{victim.suffix}"),
        "report": victim.with_name("out.json"),
    }
    given |= {option: named, "input": files["input"], read: victim}
    argv = ["--spacing", "0.4", "--iterations", "1"]
    argv += [word for name, path in given.items() for word in (f"--{name}", str(path))]
    assert batch.main(argv) == 2
    said = capsys.readouterr().err.rstrip("\n")
    assert_sentence(said)
    assert f"--{option} would overwrite --{read}" in said
    assert victim.read_bytes() == before


@pytest.mark.parametrize("name", ["out.obj/", "folder.obj/"])
def test_the_name_of_a_folder_is_none_of_a_file(
    files: dict[str, Path], name: str, capsys: pytest.CaptureFixture
) -> None:
    folder = files["input"].parent
    (folder / "folder.obj").mkdir()
    assert batch.main(["--input", str(files["input"]), "--output", f"{folder}/{name}"]) == 2
    said = capsys.readouterr().err.rstrip("\n")
    assert_sentence(said)
    assert "folder; give" in said and not (folder / "out.obj").exists()


@pytest.mark.parametrize(
    ("line", "unit", "code"),
    [("G20", "mm", 2), ("g20m3", "mm", 2), ("N10 G021", "in", 2), ("G20", "in", 0)]
    + [("G21", "mm", 0), ("G203 X1", "mm", 0), ("M3 ; not G20", "mm", 0), ("(G20)", "mm", 0)],
)
def test_a_header_says_the_unit_of_the_drawing(
    files: dict[str, Path], line: str, unit: str, code: int, capsys: pytest.CaptureFixture
) -> None:
    files["header"].write_text(f"{line}\n")
    output = files["input"].with_name("out.gcode")
    argv = ["--input", str(files["input"]), "--output", str(output), "--layout", "top"]
    argv += ["--spacing", "0.4", "--iterations", "1", "--unit", unit]
    assert batch.main([*argv, "--header", str(files["header"])]) == code
    assert output.exists() == (code == 0)
    if code:
        said = capsys.readouterr().err.splitlines()[-1]
        assert_sentence(said)
        assert "but the drawing is in" in said
