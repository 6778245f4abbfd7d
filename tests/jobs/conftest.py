# SPDX-License-Identifier: GPL-3.0-or-later
"""Jobs in a folder of their own, run by the command in a process of its own or in this one."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests"), str(ROOT / "tests" / "core"), str(ROOT / "addon")]

from meander.jobs import command  # noqa: E402
from processor_time import pytest_runtest_protocol  # noqa: E402, F401

FARM = ROOT / "addon" / "meander" / "farm.py"
FAKE = Path(__file__).with_name("fake_engine.py")


class Job:
    """A job file in a folder, its meshes, and what runs it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.file = folder / "job.toml"
        (folder / "meshes").mkdir()

    def meshes(self, **contents: str) -> None:
        """Input files by name; what the fake engine is to do stands in them."""
        for name, text in contents.items():
            (self.folder / "meshes" / f"{name}.obj").write_text(text)

    def write(self, text: str, fake: bool = True) -> None:
        """The job file, with the fake engine unless told otherwise."""
        command = json.dumps([sys.executable, str(FAKE)])
        head = f"[job]\ncommand = {command}\n" if fake else ""
        self.file.write_text(head + text)

    def fill_all(self, more: str = "", **defaults: object) -> None:
        """A job file of all meshes."""
        lines = "".join(f"{key} = {value}\n" for key, value in defaults.items())
        self.write(
            f'[defaults]\nspacing = 0.3\n{lines}{more}\n[[items]]\ninput = "meshes/*.obj"\n'
        )

    def command(self, *arguments: str) -> list[str]:
        return [sys.executable, str(FARM), str(self.file), *arguments]

    def start(self, *arguments: str) -> subprocess.Popen:
        return subprocess.Popen(
            self.command(*arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            env=self.environment,
        )  # fmt: skip

    def run(self, *arguments: str) -> subprocess.CompletedProcess:
        """As start() and its end, in this process: one of its own imports for half a second."""
        out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2))
        with (
            pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(err)
        ):  # fmt: skip
            patch.setenv("FAKE_RUNS", self.environment["FAKE_RUNS"])
            code = command.main([str(self.file), *arguments])
        for stream in (out, err):
            stream.seek(0)
        return subprocess.CompletedProcess(arguments, code, out.read(), err.read())

    @property
    def environment(self) -> dict[str, str]:
        return {**os.environ, "FAKE_RUNS": str(self.folder / "runs.txt")}

    @property
    def runs(self) -> list[str]:
        """The names of the inputs that the fake engine was started with, one for each time."""
        path = self.folder / "runs.txt"
        return sorted(path.read_text().split()) if path.exists() else []

    @property
    def results(self) -> Path:
        return self.folder / "job"

    def summary(self, name: str = "summary.json") -> dict:
        return json.loads((self.results / name).read_text())


@pytest.fixture
def job(tmp_path: Path) -> Job:
    return Job(tmp_path)
