# SPDX-License-Identifier: GPL-3.0-or-later
"""The ADMM to its very end, as what others are measured by."""

from solver.styles.admm import AdmmOptions

TIGHT = AdmmOptions(max_iterations=3000, trial=3000, absolute=1e-13, relative=1e-11)
