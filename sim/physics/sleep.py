"""Sleep of a world in which nothing moves and nothing acts: its steps would change nothing, and are left out.

Whatever acts on a body wakes it at once, so that the very step that follows is done.
"""

from __future__ import annotations

from sim.core.constants import STEPS_PER_SECOND
from sim.physics.quiet_pybullet import p

__all__ = ["SleepWatch"]

STILL_STEPS = STEPS_PER_SECOND // 2
"""Steps for which everything must be still."""
STILL_SPEED = 5e-4
"""Slower than this it is still [m/s, rad/s]: wheels that are held creep at a third of it, for contacts are solved to a residue."""
STILL_JOINT_SPEED = 0.02
"""The same of a wheel [rad/s]."""


class SleepWatch:
    """Judges one world after each of its steps."""

    def __init__(self, client: int) -> None:
        """Of the world `client`, awake."""
        self._client = client
        self._bodies: dict[int, int] = {}
        self._turning: set[tuple[int, int]] = set()
        self._acted = True
        self._still = 0

    @property
    def asleep(self) -> bool:
        """The next step would change nothing."""
        return self._still >= STILL_STEPS and not self._acted and not self._turning

    def watch(self, body: int) -> None:
        """`body` can move from now on."""
        self._bodies[body] = p.getNumJoints(body, physicsClientId=self._client)
        self.wake()

    def wake(self) -> None:
        """Something acts on a body, or was put somewhere: the next step is done, and everything must come to rest anew."""
        self._acted, self._still = True, 0

    def turn(self, body: int, joint: int, speed: float) -> None:
        """The motor of `joint` holds `speed` [rad/s]; while that of any is not 0, however slow, nothing sleeps."""
        self.wake()
        if speed:
            self._turning.add((body, joint))
        else:
            self._turning.discard((body, joint))

    def after_step(self) -> None:
        """A step was done."""
        if self._acted or self._turning:
            self._acted, self._still = False, 0
        elif all(self._is_still(body, joints) for body, joints in self._bodies.items()):
            self._still += 1
        else:
            self._still = 0

    def _is_still(self, body: int, joints: int) -> bool:
        velocity, turning = p.getBaseVelocity(body, physicsClientId=self._client)
        if max(map(abs, (*velocity, *turning))) > STILL_SPEED:
            return False
        states = p.getJointStates(body, range(joints), physicsClientId=self._client) if joints else ()
        return all(abs(speed) <= STILL_JOINT_SPEED for _, speed, _, _ in states)
