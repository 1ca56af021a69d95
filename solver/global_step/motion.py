# SPDX-License-Identifier: GPL-3.0-or-later
"""The positions of a run and how a global step moves them."""


class Motion:
    """The positions in NumPy; `backends/taichi_motion.py` has the same for large meshes.

    `local`: whose rotations the positions follow. `U`: (n,3) float64, the first positions in the
    unit box, with pinned vertices at their targets. `constraints`: applied after each step:
    ``impose(U)`` moves positions (n,3) so that they are satisfied. `point`: (n,3), positions that
    the next local step looks at.
    """

    def __init__(self, setup, local, U, constraints=()):
        self._setup, self._local, self._constraints = setup, local, constraints
        self.put(U)

    @property
    def positions(self):
        """(n,3) float64 current positions in the unit box."""
        return self._U

    def put(self, U):
        """Go to other positions (n,3)."""
        self._U = self.point = U

    def look_at_positions(self):
        """Make the next local step use the positions themselves."""
        self.point = self._U

    def relax(self, times):
        """Approach the solution for the rotations, without momentum or turning."""
        rhs = self._local.right_hand_side()
        for _ in range(times):
            self.put(self._setup.global_step.positions(rhs, self._U))

    def step(self, momentum, overshoot, keep_rotation):
        """Do one global step.

        `momentum`, `overshoot`: (component_count,), extrapolation from the new positions, see
        `Momentum.next`. `keep_rotation`: bool, keep the rotation of each component without pins.
        Returns `displacement`, `distance`: float, the largest of any coordinate, in this step and
        from rest.
        """
        rest = self._setup.rest
        U = self._setup.global_step.positions(
            self._local.right_hand_side(), self.point, keep_rotation
        )
        for constraint in self._constraints:
            constraint.impose(U)
        step, point = U - self._U, U - self.point
        displacement = largest(step)
        if rest.topology.component_count > 1:
            momentum, overshoot = (
                share[rest.topology.component][:, None] for share in (momentum, overshoot)
            )
        step *= momentum
        point *= overshoot
        point += step
        point += U
        self.point, self._U = point, U
        return displacement, largest(U - rest.V)


def largest(values):
    """Return the largest size of any value."""
    return float(max(values.max(), -values.min()))
