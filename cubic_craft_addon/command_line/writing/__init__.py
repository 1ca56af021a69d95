# SPDX-License-Identifier: GPL-3.0-or-later
"""Results as files: meshes with the vertices of the input, and the report."""
