# SPDX-License-Identifier: GPL-3.0-or-later
"""From objects and settings to results: read, prepare, solve, write.

``tasks`` says what there is to solve, ``member`` reads one object, ``assembly`` factorises what is
solved at once, ``fields`` says what each vertex is asked for, and ``pipeline`` solves and writes.
"""
