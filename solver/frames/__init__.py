# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of an animation: each starts from the one before, and is steadied."""
