# SPDX-License-Identifier: GPL-3.0-or-later
"""Many files, each in a process of its own, so that a crash in one of them never ends the batch.

`sources` finds the files and names their results, `task` does one file, and `run` does it all.
"""
