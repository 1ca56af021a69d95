# SPDX-License-Identifier: GPL-3.0-or-later
"""What is found on a surface: angles to the form, planar facets, faces that cross others."""
