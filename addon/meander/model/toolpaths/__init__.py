# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands as machines follow them: resampled, laid flat, joined, and a module for each format."""
