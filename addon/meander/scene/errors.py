# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with a scene, as a sentence for its user."""


class DataError(ValueError):
    """Something in the scene cannot be used; str() is one sentence for people."""
