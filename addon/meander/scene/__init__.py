# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads Blender data into arrays, and writes arrays back as Blender data."""
