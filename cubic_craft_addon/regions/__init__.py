# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions: vertex groups with a form, an orientation and a cubeness of their own."""
