# SPDX-License-Identifier: GPL-3.0-or-later
"""Target shapes: the problem of the local step, and its solution.

Currently the cube: its problem is in ``local_problem``, solved by ``active_set`` and, from any
start, by ``admm``; ``cube`` has everything else that is specific to it.
"""
