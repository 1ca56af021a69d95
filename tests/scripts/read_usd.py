# SPDX-License-Identifier: GPL-3.0-or-later
"""Print the points of each mesh in each frame of a USD file, by the reference library, as JSON."""

import json
import sys

from pxr import Usd, UsdGeom

stage = Usd.Stage.Open(sys.argv[1])
first, last = int(stage.GetStartTimeCode()), int(stage.GetEndTimeCode())
meshes = [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
frames = range(first, last + 1)
json.dump(
    {
        "frames": [first, last],
        "points": {
            mesh.GetPrim().GetParent().GetName(): [
                [list(map(float, point)) for point in mesh.GetPointsAttr().Get(frame)]
                for frame in frames
            ]
            for mesh in meshes
        },
    },
    sys.stdout,
)
