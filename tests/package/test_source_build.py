# SPDX-License-Identifier: GPL-3.0-or-later
"""What a build from the sources asks of a machine, and what it says where that is not there."""

from __future__ import annotations

import subprocess
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_a_build_takes_every_python_that_pip_does() -> None:
    least = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["requires-python"]
    version = least.removeprefix(">=")
    assert f"find_package(Python3 {version} " in (ROOT / "cmake/dependencies.cmake").read_text()


@pytest.mark.parametrize("lacking", ["Eigen3", "nanoflann"])
def test_headers_that_are_missing_are_a_sentence(tmp_path: Path, lacking: str) -> None:
    command = ["cmake", "-S", ROOT, "-B", tmp_path, "-G", "Ninja", "-DMEANDER_STAGE=OFF",
               f"-DCMAKE_DISABLE_FIND_PACKAGE_{lacking}=ON"]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    said = " ".join(done.stderr.split())
    assert done.returncode == 1 and f"The headers of {lacking} are missing" in said
    assert "apt install libeigen3-dev libnanoflann-dev" in said and "MEANDER_HEADERS=" in said
