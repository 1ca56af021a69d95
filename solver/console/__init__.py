# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command line of the extension and that of the package share.

It is here because both have the solver, and it needs nothing of it, neither NumPy nor bpy.
"""
