# SPDX-License-Identifier: GPL-3.0-or-later
"""What a surface is to become: the problem of the local step, and how it is solved.

Today the cube: its problem is in ``local_problem``, solved by ``active_set`` and, from any start,
by ``admm``; ``cube`` has what else is special about it.
"""
