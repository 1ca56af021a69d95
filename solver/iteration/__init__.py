# SPDX-License-Identifier: GPL-3.0-or-later
"""The local-global iteration toward a style in a pose, from the first step to the result."""
