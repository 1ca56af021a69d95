# SPDX-License-Identifier: GPL-3.0-or-later
"""A coarser mesh is solved first, and what is found there begins on the finer one."""
