# SPDX-License-Identifier: GPL-3.0-or-later
"""Show Angles: how far each part of the surface still is from the form.

``measured`` measures it, and ``overlay`` keeps it until something changes and draws it, with its
``legend``.
"""
