# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the modules of the sweep importable, and those of tests/core that they use."""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests"), str(ROOT / "tests" / "core")]

from processor_time import pytest_runtest_protocol  # noqa: E402, F401
