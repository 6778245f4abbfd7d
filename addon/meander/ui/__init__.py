# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user sees and touches: settings, operators, panels."""
