# SPDX-License-Identifier: GPL-3.0-or-later
"""The rooms of ``headless_render.py``: read, cubify, save, picture and report."""
