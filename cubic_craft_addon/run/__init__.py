# SPDX-License-Identifier: GPL-3.0-or-later
"""From objects and settings to results: read, solve, write.

``tasks`` lists what to solve and writes all results, ``pipeline`` has one problem solved, and
``stepwise_run`` does so phase by phase.
"""
