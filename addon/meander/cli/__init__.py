# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command: options in, files out."""
