# SPDX-License-Identifier: GPL-3.0-or-later
"""What every complaint has to look like."""

from __future__ import annotations


def assert_sentence(text: str) -> None:
    """One line, one sentence, said in words."""
    assert text == text.strip()
    assert "\n" not in text
    assert len(text.split()) >= 4, text
    # A full stop inside would begin a second sentence.
    assert ". " not in text, text
