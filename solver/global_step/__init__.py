# SPDX-License-Identifier: GPL-3.0-or-later
"""The global step: what is factorized or solved in cycles, and the constraints that hold parts."""
