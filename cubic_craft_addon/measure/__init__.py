# SPDX-License-Identifier: GPL-3.0-or-later
"""What is found on a surface: planar facets."""
