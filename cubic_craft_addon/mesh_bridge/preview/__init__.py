# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that are shown for a while, and taken back by what lies on the mesh itself."""
