# SPDX-License-Identifier: GPL-3.0-or-later
"""The native tests, built for other systems than this one and run there by Wine and qemu."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from conftest import ROOT, platforms

SUFFIX = {"windows-x64": ".exe", "linux-arm64": ""}
EMULATED = [name for name in platforms() if name in SUFFIX]
# The programs that scripts/package.sh builds for them, and the fewest that there have to be: what
# differs between systems is arithmetic, threads, exact signs, and cancelling.
FEWEST = {"test_elementary", "test_thread_pool", "test_crossings", "test_job"}


def programs(emulated: str) -> list[str]:
    folder = ROOT / "build/package" / emulated
    every = sorted(path.stem for path in (ROOT / "tests/native").glob("test_*.cpp"))
    return [name for name in every if (folder / f"{name}{SUFFIX[emulated]}").is_file()]


@pytest.mark.parametrize("emulated", EMULATED)
def test_are_built(emulated: str) -> None:
    assert FEWEST <= set(programs(emulated))


@pytest.mark.parametrize(
    ("emulated", "name"), [(emulated, name) for emulated in EMULATED for name in programs(emulated)]
)
def test_native(emulated: str, name: str, runner: Callable[..., str]) -> None:
    program = ROOT / "build/package" / emulated / f"{name}{SUFFIX[emulated]}"
    output = runner(emulated, program, "--gtest_color=no", timeout=1800)
    # A program that ends before its tests must not count as one that has passed.
    assert re.search(r"^\[  PASSED  \] [1-9]", output, re.MULTILINE), output[-2000:]
