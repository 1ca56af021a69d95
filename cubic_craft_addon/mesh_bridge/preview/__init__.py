# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that are shown temporarily, and reverted from data on the mesh itself."""
