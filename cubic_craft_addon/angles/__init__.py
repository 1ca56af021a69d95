# SPDX-License-Identifier: GPL-3.0-or-later
"""Show Angles: how far each part of the surface still is from the form.

``measured`` measures it, ``kept`` keeps it until something changes, and ``overlay`` draws it, with
its ``legend``.
"""
