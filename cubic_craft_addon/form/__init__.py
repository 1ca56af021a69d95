# SPDX-License-Identifier: GPL-3.0-or-later
"""The form: what a ball would become, and what the surface is turned toward.

``settings`` has what the artist sets, and ``body`` makes the form for the solver.
"""
