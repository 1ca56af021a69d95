# SPDX-License-Identifier: GPL-3.0-or-later
"""Beams of what is mostly a box lie as that does, however roughly they are known."""

import numpy as np
import scipy.sparse as sp
from proxy_shapes import box
from shapes import rotation

from solver.limbs import Limbs, along_boxes
from solver.mesh.rest_measures import triangle_areas_and_normals


def test_a_beam_along_its_box_has_the_frame_of_the_object():
    V, F = box((4.0, 1.0, 1.0))
    measures = triangle_areas_and_normals(V, F)
    limbs = Limbs(np.array([[0.97, 0.2425, 0.0]]), sp.csr_matrix(np.ones((len(V), 1))))

    def found(turn):
        frames = np.tile(turn.T, (len(V), 1, 1))
        return along_boxes(limbs, frames, F, *measures).directions

    assert not found(np.eye(3)).any()
    assert (found(rotation(z=20.0)) == limbs.directions).all(), "a bar that is aslant keeps its own"
    assert along_boxes(limbs, None, F, *measures) is limbs
