# SPDX-License-Identifier: GPL-3.0-or-later
"""From objects and settings to results: read, prepare, solve, write.

``tasks`` lists what to solve, ``member`` reads one object, ``assembly`` factorises what is solved
together, ``fields`` has the settings of each vertex, and ``pipeline`` solves and writes.
"""
