# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects on their way into the solver and back.

A `Piece` is one object with its handles, regions and symmetry, placed where it is solved. A
`Problem` joins pieces into one mesh, has it solved, and splits the result into the coordinates of
its objects.

Nothing here loads SciPy when it is imported: the extension imports these modules when Blender
starts.
"""
