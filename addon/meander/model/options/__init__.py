# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of the options: a module for each group of rows."""
