# SPDX-License-Identifier: GPL-3.0-or-later
"""Clothes that lie on the mesh without being selected: found, named, and selected by a click."""
