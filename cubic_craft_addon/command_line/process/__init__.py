# SPDX-License-Identifier: GPL-3.0-or-later
"""The process and what it leaves behind: errors, output files, signals, progress; no bpy in it."""
