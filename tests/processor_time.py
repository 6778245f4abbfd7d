# SPDX-License-Identifier: GPL-3.0-or-later
"""Notes the processor time of every test, as tests/native/processor_time.cpp does for C++.

One line "SECONDS NAME" is added to the file that the variable MEANDER_TEST_TIMES names; without it
nothing is done. Processor time and not the clock, since other work on the machine must not make a
test look slow. A suite of pytest's takes part when its conftest.py imports the hook from here.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest


def spent() -> float:
    """Seconds of all threads of this process, and of the programs that it has waited for."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def note(name: str, seconds: float) -> None:
    """Adds a line about the test `name`."""
    path = os.environ.get("MEANDER_TEST_TIMES")
    if path:
        with open(path, "a", encoding="utf-8") as file:
            file.write(f"{seconds:.2f} {name}\n")


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Notes a test with what its fixtures do."""
    begin = spent()
    yield
    note(item.nodeid, spent() - begin)
