# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the modules of the mutation tests importable."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path += [str(HERE), str(HERE.parent)]

from processor_time import pytest_runtest_protocol  # noqa: E402, F401
