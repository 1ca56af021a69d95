# SPDX-License-Identifier: GPL-3.0-or-later
"""From objects and settings to results: read, prepare, solve, write.

``tasks`` says what there is to solve, ``member`` reads one object, ``assembly`` factorises what is
solved at once, and ``pipeline`` solves and writes it. ``last_run`` is what is told about it.
"""
