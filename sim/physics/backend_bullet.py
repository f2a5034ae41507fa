"""One world of the physics engine pybullet, and what can be measured in it.

Everything outside this room talks to `Bullet` in shapes, numbers and tuples, so that another engine can take its place.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.shapes import Quat, Shape, Vec3, place
from sim.physics.bodies import Contact, Floating, Joint, State, WheeledBody
from sim.physics.bullet_bodies import BodyMaker
from sim.physics.bullet_measures import Measures
from sim.physics.fans import Echoes, Fan
from sim.physics.quiet_pybullet import p, quiet
from sim.physics.sleep import SleepWatch
from sim.physics.zero_pages import given_back

__all__ = ["Bullet", "Contact", "Joint", "State", "WheeledBody"]

SKY = (160, 200, 238)
"""Colour of `Bullet.picture` where there is nothing: red, green, blue, 0 to 255."""

Picture = NDArray[np.uint8]

_SKY_DEPTH = 0.99999
"""Depth, 0 near to 1 far, from which on a pixel shows nothing."""
_ALL_GROUPS = -1
_FIRST_GROUP, _GROUPS = 64, 24
"""Collision groups of vehicles, one each, so that a vehicle's own rays look through it; the 25th shares the first's."""
_WINDOW_DISTANCE = 7.0
"""Distance from which the window shows the robots at first [m]."""
_SOLVER_RESIDUAL = 1e-6
"""Square of the contacts' error at which the solver stops; pybullet's own 1e-7 costs a tenth more time and changes no path."""


class Bullet:
    """One world of rigid bodies in discrete time."""

    def __init__(self, *, gui: bool = False) -> None:
        """An empty world; `gui` opens pybullet's own window, which needs a display."""
        self._gui = gui
        with quiet(), contextlib.nullcontext() if gui else given_back():
            self._client: int = p.connect(p.GUI if gui else p.DIRECT)
        if self._client < 0:
            raise RuntimeError("The physics engine could not open its window; is there a display?")
        p.setGravity(0, 0, -GRAVITY, physicsClientId=self._client)
        p.setPhysicsEngineParameter(
            fixedTimeStep=1 / STEPS_PER_SECOND,
            deterministicOverlappingPairs=1,
            solverResidualThreshold=_SOLVER_RESIDUAL,
            physicsClientId=self._client,
        )
        if gui:
            # each thing that is made waits for a picture while pictures are made
            for off in (p.COV_ENABLE_GUI, p.COV_ENABLE_SHADOWS, p.COV_ENABLE_RENDERING):
                p.configureDebugVisualizer(off, 0, physicsClientId=self._client)
        self._make = BodyMaker(self._client, visible=gui)
        self._sleep = SleepWatch(self._client)
        self._below: dict[int, Vec3] = {}
        self._groups: dict[int, int] = {}
        self._radii: dict[int, float] = {}
        self._measures = Measures(self._client, self._groups, self._radii)
        self.ground = -1
        """Number of the ground; -1 when there is none."""

    def add_ground(self, height: float = 0.0, grip: float = 1.0) -> int:
        """The level ground at z = `height` [m]; its number.

        On it every body has its own friction times `grip`.
        """
        self._wake()
        self._measures.fixed.add_ground(height)
        self.ground = self._make.ground(height, grip)
        return self.ground

    def add_static(self, shapes: Sequence[Shape]) -> int:
        """One thing made of solids that nothing moves; its number, or that of its first part when it has many solids.

        A step costs time for each thing, not for each solid: what belongs together is added together.
        """
        self._wake()
        self._measures.fixed.add(shapes)
        return self._make.static(shapes)

    def add_looks(self, shape: Shape) -> int:
        """A visual shape for `picture`, which collides with nothing; its number."""
        return self._make.looks(shape)

    def add_body(self, shape: Shape, mass: float) -> int:
        """A free rigid body of one `shape` and `mass` [kg]; its number."""
        body = self._make.single(shape, mass)
        self._below[body] = (0.0, 0.0, 0.0)
        self._radii[body] = shape.radius
        self._sleep.watch(body)
        self._wake()
        return body

    def add_wheeled(self, spec: WheeledBody, position: Vec3, rotation: Quat) -> int:
        """A wheeled vehicle; its number. Its joints are the driven wheels in the order of `spec.wheels`."""
        return self._enter(self._make.wheeled(spec, position, rotation), spec)

    def add_floating(self, spec: Floating, position: Vec3, rotation: Quat) -> int:
        """A single free body; its number."""
        return self._enter(self._make.floating(spec, position, rotation), spec)

    def _enter(self, body: int, spec: WheeledBody | Floating) -> int:
        """Put a vehicle into a collision group of its own, and keep where its centre of mass is and how far it reaches."""
        com = spec.centre_of_mass
        self._groups[body] = group = _FIRST_GROUP << (len(self._groups) % _GROUPS)
        for link in range(-1, p.getNumJoints(body, physicsClientId=self._client)):
            p.setCollisionFilterGroupMask(body, link, group, _ALL_GROUPS, physicsClientId=self._client)
        self._below[body] = (-com[0], -com[1], -com[2])
        self._radii[body] = spec.radius
        self._sleep.watch(body)
        self._wake()
        return body

    @property
    def asleep(self) -> bool:
        """Nothing moves and nothing acts, so that a step changes nothing."""
        return self._sleep.asleep

    def step(self) -> None:
        """Advance by one fixed step."""
        if self._sleep.asleep and not self._gui:  # there, a hand may drag something
            return
        p.stepSimulation(physicsClientId=self._client)
        self._sleep.after_step()
        self._measures.forget()

    def _wake(self) -> None:
        """Something was put somewhere else."""
        self._sleep.wake()
        self._measures.forget()

    def state(self, body: int) -> State:
        """Pose and motion of `body`."""
        position, rotation, velocity, turning = self.motion(body)
        return State(place(self._below[body], position, rotation), rotation, velocity, turning)

    def place(self, body: int, position: Vec3, rotation: Quat) -> None:
        """Put `body` somewhere else, at rest, its joints as they are."""
        self._wake()
        below = self._below[body]
        centre = place((-below[0], -below[1], -below[2]), position, rotation)
        p.resetBasePositionAndOrientation(body, centre, rotation, physicsClientId=self._client)
        p.resetBaseVelocity(body, (0, 0, 0), (0, 0, 0), physicsClientId=self._client)
        for joint in range(p.getNumJoints(body, physicsClientId=self._client)):
            angle = p.getJointState(body, joint, physicsClientId=self._client)[0]
            p.resetJointState(body, joint, angle, 0.0, physicsClientId=self._client)

    def joints(self, body: int, count: int) -> list[Joint]:
        """The first `count` joints of `body`."""
        states = p.getJointStates(body, range(count), physicsClientId=self._client)
        return [Joint(angle, speed, torque) for angle, speed, _, torque in states]

    def spin(self, body: int, joint: int, speed: float, torque: float) -> None:
        """Let the motor of `joint` hold `speed` [rad/s] with at most `torque` [N m], until the next order."""
        self._sleep.turn(body, joint, speed)
        p.setJointMotorControl2(
            body, joint, p.VELOCITY_CONTROL, targetVelocity=speed, force=torque, physicsClientId=self._client
        )

    def apply(self, body: int, at: Vec3, force: Vec3, torque: Vec3) -> None:
        """Let `force` [N] act on `body` `at` a point [m], and `torque` [N m], for one step; all in the world's frame."""
        client = self._client
        self._sleep.wake()
        p.applyExternalForce(body, -1, force, at, p.WORLD_FRAME, physicsClientId=client)
        p.applyExternalTorque(body, -1, torque, p.WORLD_FRAME, physicsClientId=client)

    def motion(self, body: int) -> tuple[Vec3, Quat, Vec3, Vec3]:
        """Position [m], rotation, velocity [m/s] and turning [rad/s] of the centre of mass of `body`."""
        position, rotation = p.getBasePositionAndOrientation(body, physicsClientId=self._client)
        velocity, turning = p.getBaseVelocity(body, physicsClientId=self._client)
        return position, rotation, velocity, turning

    def set_velocity(self, body: int, velocity: Vec3, turning: Vec3) -> None:
        """Let the centre of mass of `body` move with `velocity` [m/s] and turn with `turning` [rad/s] from now on."""
        self._sleep.wake()
        p.resetBaseVelocity(body, velocity, turning, physicsClientId=self._client)

    def rays(self, body: int, start: Sequence[Vec3], end: Sequence[Vec3]) -> NDArray[np.float64]:
        """Reach of each ray, as a part of its length: 1 when it hits nothing.

        `start` and `end` are in the frame of the body's centre of mass, see `ray_points`; the body itself is not hit.
        While nothing moves, the very same lists give the very same array, which is not to be changed.
        """
        return self._measures.rays(body, start, end)

    def fan(self, body: int, start: Vec3, *, first: float, step: float, count: int, reach: float) -> Fan:
        """Beams from `start` [m] of the body's frame, level in it, as `sweep` takes them; see `Fan`."""
        (point,) = self.ray_points(body, [start])
        return Fan(point, first, step, count, reach)

    def sweep(self, body: int, fan: Fan) -> NDArray[np.float64]:
        """Reach of each beam of a `fan`, as a part of its length: 1 when it meets nothing; the body itself is not met.

        As `rays` would give it, to a millimetre, but that:

        - `rays` has tapered solids a millimetre too large, which is centimetres along a beam that grazes one;
        - of a beam on the very edge of any solid, one of both may say that it meets the solid and the other that it passes;
        - from below the ground a beam does not meet it here;
        - from within a fixed sphere a beam looks through it here, and `rays` gives 0 for one towards its middle.

        While nothing moves, the very same fan gives the very same array, which is not to be changed.
        """
        return self._measures.sweep(body, fan).reach

    def echoes(self, body: int, fan: Fan) -> Echoes:
        """What `sweep` gives, and how strong each echo is.

        Matt things answer with less than 100, the less the darker they are and the more askew the beam meets them; what throws
        light straight back with 200 and more, up to 60 degrees from straight on. How far they are makes no difference: a
        laser allows for it. The arrays are not to be changed.
        """
        return self._measures.sweep(body, fan)

    def ray_points(self, body: int, points: Sequence[Vec3]) -> list[Vec3]:
        """`points` of the body's frame as `rays` takes them."""
        below = self._below[body]
        return [(x + below[0], y + below[1], z + below[2]) for x, y, z in points]

    def touching(self, body: int) -> list[Contact]:
        """Contacts of the shell of a vehicle; its wheels and casters do not count."""
        return self._measures.touching(body)

    def is_crowded(self, body: int, distance: float, *, but: int = -1) -> bool:
        """Whether anything is nearer to `body` than `distance` [m], apart from the ground and one other body."""
        client = self._client
        others = {p.getBodyUniqueId(number, client) for number in range(p.getNumBodies(client))}
        return any(
            p.getClosestPoints(body, other, distance, physicsClientId=client)
            for other in sorted(others - {body, self.ground, but})
        )

    def picture(
        self, eye: Vec3, target: Vec3, up: Vec3, field_of_view: float, size: tuple[int, int]
    ) -> Picture:
        """The view of a camera, drawn by pybullet's own slow software renderer: (height, width, 3) RGB.

        `field_of_view` is the vertical one [rad]; only bodies made by `add_looks` have looks. Where there is nothing,
        the picture is `SKY`.
        """
        width, height = size
        view = p.computeViewMatrix(eye, target, up)
        projection = p.computeProjectionMatrixFOV(
            float(np.degrees(field_of_view)), width / height, 0.05, 120.0
        )
        _, _, colours, depths, _ = p.getCameraImage(
            width,
            height,
            view,
            projection,
            shadow=0,
            lightDirection=(-0.46, -0.52, 0.72),
            renderer=p.ER_TINY_RENDERER,
            flags=p.ER_NO_SEGMENTATION_MASK,
            physicsClientId=self._client,
        )
        picture: Picture = np.array(np.reshape(colours, (height, width, 4))[:, :, :3], dtype=np.uint8)
        picture[np.reshape(depths, (height, width)) >= _SKY_DEPTH] = SKY
        return picture

    def show(self, at: Vec3) -> None:
        """Show all bodies in the window, if there is one, from behind and above the place `at` [m]."""
        if self._gui:
            client = self._client
            p.resetDebugVisualizerCamera(_WINDOW_DISTANCE, 0, -30, at, physicsClientId=client)
            p.configureDebugVisualizer(p.COV_ENABLE_RENDERING, 1, physicsClientId=client)

    def close(self) -> None:
        """Free the world; closing twice does nothing."""
        if self._client >= 0:
            with quiet():
                p.disconnect(self._client)
            self._client = -1
