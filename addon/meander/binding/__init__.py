# SPDX-License-Identifier: GPL-3.0-or-later
"""All of ctypes: the library file, its structs and functions, and the objects made of them.

`core` is the door; nothing else imports from here.
"""
