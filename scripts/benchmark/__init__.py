# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure the solver side by side with its peers; run as ``python scripts/benchmark``."""
