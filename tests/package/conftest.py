# SPDX-License-Identifier: GPL-3.0-or-later
"""What is tested here is the zip that people download, in Blenders that know nothing else.

MEANDER_ZIP          the zip; default: the newest build/meander-*.zip
MEANDER_BPY_PYTHON   a Python with bpy 4.2 or later; default: build/bpy-4.5
"""

import os
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests"), str(ROOT / "tests" / "core")]

from processor_time import pytest_runtest_protocol  # noqa: E402, F401


@pytest.fixture(scope="session")
def addon_zip() -> Path:
    named = os.environ.get("MEANDER_ZIP")
    if named:
        return Path(named)
    built = sorted(ROOT.glob("build/meander-*.zip"), key=lambda path: path.stat().st_mtime)
    assert built, "no build/meander-*.zip: run scripts/build.sh"
    return built[-1]


@pytest.fixture(scope="session")
def bpy_python() -> Path:
    return Path(os.environ.get("MEANDER_BPY_PYTHON", ROOT / "build/bpy-4.5/bin/python"))
