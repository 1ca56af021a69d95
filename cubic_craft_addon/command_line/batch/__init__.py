# SPDX-License-Identifier: GPL-3.0-or-later
"""Many files, each in a process of its own, so that a crash in one of them never ends the batch.

`task` finds the files, names their results and does one file, and `run` does it all.
"""
