# SPDX-License-Identifier: GPL-3.0-or-later
"""Many surfaces on many machines: a job file, and what runs its items; no bpy.

job_file    what the file says        options     its keys as flags of the batch command
items       globs, objects, frames    objects     which meshes a .blend holds
engine      what fills an item        child       the process of one, within its limits
folder      what is done, and by whom
worker      all items, one after the other or several at once
progress    what is said of it        slurm       a script for Slurm
command     all of it from the command line, which farm.py starts
"""
