# SPDX-License-Identifier: GPL-3.0-or-later
"""Which iterations show how a curve grew."""

import numpy as np
from meander.model.stages import stages_of


def test_stages_are_even_in_length_and_then_in_iterations() -> None:
    # Grows faster and faster, then wavers about what it has.
    growth = np.geomspace(0.1, 10.0, 100)
    lengths = np.concatenate([growth, 10.0 + 0.2 * np.sin(np.arange(300))])
    stages = stages_of(lengths, 50)
    assert stages[0] == 0 and stages[-1] == 400 and len(stages) <= 51
    before = [n for n in stages if 0 < n < 95]
    steps = np.diff([lengths[n - 1] for n in before])
    assert len(before) > 20 and steps.max() < 3.0 * np.median(steps)
    after = np.diff([n for n in stages if n > 105])
    assert len(after) > 5 and np.ptp(after) <= 1


def test_few_iterations_are_all_stages() -> None:
    assert stages_of([1.0, 2.0, 3.0], 50) == [0, 1, 2, 3]
    assert stages_of([1.0], 2) == [0, 1]
    assert stages_of([], 10) == [0]
    # A curve that has its length from the start, and one that shrinks.
    assert stages_of([5.0, 5.0, 5.0, 5.0], 3)[::len(stages_of([5.0] * 4, 3)) - 1] == [0, 4]
    assert stages_of([5.0, 4.0, 3.0], 4)[-1] == 3
