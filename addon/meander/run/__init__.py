# SPDX-License-Identifier: GPL-3.0-or-later
"""A run from its plan to its result, watched or not; and curves on surfaces that move."""
