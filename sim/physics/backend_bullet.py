"""The physics engine: the only file that knows pybullet.

Everything else talks to `Bullet` in shapes, numbers and tuples, so that another engine can take its place.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.shapes import Quat, Shape, Vec3, place
from sim.core.zero_pages import given_back
from sim.physics.bodies import Contact, Floating, Joint, State, WheeledBody

__all__ = ["Bullet", "Contact", "Joint", "State", "WheeledBody"]

SKY = (160, 200, 238)
"""What `Bullet.picture` shows where there is nothing: red, green, blue, 0 to 255."""

Picture = NDArray[np.uint8]

_NOTHING = 0.99999
"""Depth, 0 near to 1 far, from which on a pixel shows nothing."""
_EVERYTHING = -1
_FIRST_GROUP, _GROUPS = 64, 24
"""Collision groups of vehicles, one each, so that a vehicle's own rays look through it; the 25th shares the first's."""
_WINDOW_AWAY = 7.0
"""From which the window looks at the robots at first [m]."""
_MOST_SOLIDS = 16
"""Of a thing; pybullet leaves out what is more, without a word."""
_GOOD_ENOUGH = 1e-6
"""What may be left of the contacts' error, squared; pybullet's own 1e-7 costs a tenth more and moves nobody elsewhere."""
_PLAIN = 1
"""What nothing moves has no joints; pybullet would take it for a robot without any and reckon with it in every step."""
_KNUCKLE = 0.5
"""Mass of what a steered wheel hangs on [kg], and its moments of inertia [kg m2]."""


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Silence the C code's prints, which go to the file descriptors and not through Python."""
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.flush()
    saved = [(fd, os.dup(fd)) for fd in (1, 2)]
    sink = os.open(os.devnull, os.O_WRONLY)
    try:
        for fd, _ in saved:
            os.dup2(sink, fd)
        yield
    finally:
        # What C has buffered would otherwise come out after all, once the descriptors are back.
        ctypes.CDLL(None).fflush(None)
        for fd, copy in saved:
            os.dup2(copy, fd)
            os.close(copy)
        os.close(sink)


with _quiet():
    import pybullet as p


class Bullet:
    """One world of rigid bodies in discrete time."""

    def __init__(self, *, gui: bool = False) -> None:
        """An empty world; `gui` opens pybullet's own window, which needs a display."""
        self._gui = gui
        with _quiet(), contextlib.nullcontext() if gui else given_back():
            self._client: int = p.connect(p.GUI if gui else p.DIRECT)
        if self._client < 0:
            raise RuntimeError("The physics engine could not open its window; is there a display?")
        p.setGravity(0, 0, -GRAVITY, physicsClientId=self._client)
        p.setPhysicsEngineParameter(
            fixedTimeStep=1 / STEPS_PER_SECOND,
            deterministicOverlappingPairs=1,
            solverResidualThreshold=_GOOD_ENOUGH,
            physicsClientId=self._client,
        )
        if gui:
            # each thing that is made waits for a picture while pictures are made
            for off in (p.COV_ENABLE_GUI, p.COV_ENABLE_SHADOWS, p.COV_ENABLE_RENDERING):
                p.configureDebugVisualizer(off, 0, physicsClientId=self._client)
        self._below: dict[int, Vec3] = {}
        self._groups: dict[int, int] = {}
        self.ground = -1
        """Number of the ground; -1 when there is none."""

    def add_ground(self, height: float = 0.0) -> int:
        """The level ground at z = `height` [m]; its number."""
        shape = p.createCollisionShape(p.GEOM_PLANE, physicsClientId=self._client)
        looks = -1
        if not self._gui:  # Bullet would else keep 10 MB of a chequered plane that nobody sees
            speck = (0.001, 0.001, 0.001)
            looks = p.createVisualShape(p.GEOM_BOX, halfExtents=speck, physicsClientId=self._client)
        self.ground = int(
            p.createMultiBody(
                0,
                shape,
                looks,
                basePosition=(0, 0, height),
                useMaximalCoordinates=_PLAIN,
                physicsClientId=self._client,
            )
        )
        return self.ground

    def add_static(self, shapes: Sequence[Shape]) -> int:
        """One thing made of solids that nothing moves; its number, or that of its first part when it has many solids.

        A step costs time for each thing, not for each solid: what belongs together is added together.
        """
        if len(shapes) > _MOST_SOLIDS:
            first = self.add_static(shapes[:_MOST_SOLIDS])
            self.add_static(shapes[_MOST_SOLIDS:])
            return first
        if len(shapes) == 1:
            shape = shapes[0]
            number, place_ = self._collision(shape), (shape.position, shape.rotation)
        else:
            number, place_ = self._compound(shapes), ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
        body = int(
            p.createMultiBody(
                0, number, -1, *place_, useMaximalCoordinates=_PLAIN, physicsClientId=self._client
            )
        )
        if self._gui:
            for shape in shapes:
                self.add_looks(shape)
        return body

    def add_body(self, shape: Shape, mass: float) -> int:
        """A free rigid body of one `shape` and `mass` [kg]; its number."""
        body = int(
            p.createMultiBody(
                mass,
                self._collision(shape),
                self._visual(shape),
                shape.position,
                shape.rotation,
                physicsClientId=self._client,
            )
        )
        self._undamp(body)
        self._below[body] = (0.0, 0.0, 0.0)
        return body

    def add_wheeled(self, spec: WheeledBody, position: Vec3, rotation: Quat) -> int:
        """A wheeled vehicle; its number.

        Its joints are the driven wheels in the order of `spec.wheels`, then of each steered wheel the knuckle and the
        wheel itself.
        """
        com = spec.centre_of_mass
        wheel = self._collision(Shape("sphere", (2 * spec.wheel_radius,) * 3))
        links = [_Link(_less(centre, com), spec.wheel_mass, wheel) for centre in spec.wheels]
        for centre in spec.steered:
            links.append(_Link(_less(centre, com), _KNUCKLE, axis=(0, 0, 1)))
            links.append(_Link((0.0, 0.0, 0.0), spec.wheel_mass, wheel, parent=len(links)))
        if spec.casters:
            caster = self._collision(Shape("sphere", (2 * spec.caster_radius,) * 3))
            links += [
                _Link(_less(centre, com), spec.caster_mass, caster, kind=p.JOINT_FIXED)
                for centre in spec.casters
            ]
        body = self._add_moving(spec, links, position, rotation)
        self._set_wheels(body, spec)
        return body

    def add_floating(self, spec: Floating, position: Vec3, rotation: Quat) -> int:
        """A single free body; its number."""
        return self._add_moving(spec, [], position, rotation)

    def _add_moving(
        self, spec: WheeledBody | Floating, links: list[_Link], position: Vec3, rotation: Quat
    ) -> int:
        com = spec.centre_of_mass
        offset = _less(spec.shell.position, com)
        body = int(
            p.createMultiBody(
                baseMass=spec.mass,
                baseCollisionShapeIndex=self._collision(spec.shell, offset),
                baseVisualShapeIndex=self._visual(spec.shell, offset),
                basePosition=place(com, position, rotation),
                baseOrientation=rotation,
                linkMasses=[link.mass for link in links],
                linkCollisionShapeIndices=[link.collision for link in links],
                linkVisualShapeIndices=[-1] * len(links),
                linkPositions=[link.position for link in links],
                linkOrientations=[(0, 0, 0, 1)] * len(links),
                linkInertialFramePositions=[(0, 0, 0)] * len(links),
                linkInertialFrameOrientations=[(0, 0, 0, 1)] * len(links),
                linkParentIndices=[link.parent for link in links],
                linkJointTypes=[link.kind for link in links],
                linkJointAxis=[link.axis for link in links],
                physicsClientId=self._client,
            )
        )
        self._undamp(body)
        p.changeDynamics(
            body,
            -1,
            lateralFriction=spec.friction,
            localInertiaDiagonal=spec.inertia,
            physicsClientId=self._client,
        )
        self._groups[body] = group = _FIRST_GROUP << (len(self._groups) % _GROUPS)
        for link in range(-1, len(links)):
            p.setCollisionFilterGroupMask(body, link, group, _EVERYTHING, physicsClientId=self._client)
        self._below[body] = (-com[0], -com[1], -com[2])
        return body

    def step(self) -> None:
        """Advance by one fixed step."""
        p.stepSimulation(physicsClientId=self._client)

    def state(self, body: int) -> State:
        """Where `body` is and how it moves."""
        position, rotation, velocity, turning = self.moving(body)
        return State(place(self._below[body], position, rotation), rotation, velocity, turning)

    def place(self, body: int, position: Vec3, rotation: Quat) -> None:
        """Put `body` somewhere else, at rest, its joints as they are."""
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
        """Let the motor of `joint` hold `speed` [rad/s] with at most `torque` [N m], until told otherwise."""
        p.setJointMotorControl2(
            body, joint, p.VELOCITY_CONTROL, targetVelocity=speed, force=torque, physicsClientId=self._client
        )

    def steer(self, body: int, joint: int, angle: float, torque: float) -> None:
        """Let the motor of `joint` hold `angle` [rad] with at most `torque` [N m], until told otherwise."""
        p.setJointMotorControl2(
            body, joint, p.POSITION_CONTROL, targetPosition=angle, force=torque, physicsClientId=self._client
        )

    def push(self, body: int, at: Vec3, force: Vec3, torque: Vec3) -> None:
        """Let `force` [N] act on `body` `at` a point [m], and `torque` [N m], for one step; all in the world's frame."""
        client = self._client
        p.applyExternalForce(body, -1, force, at, p.WORLD_FRAME, physicsClientId=client)
        p.applyExternalTorque(body, -1, torque, p.WORLD_FRAME, physicsClientId=client)

    def moving(self, body: int) -> tuple[Vec3, Quat, Vec3, Vec3]:
        """Position [m], rotation, velocity [m/s] and turning [rad/s] of the centre of mass of `body`."""
        position, rotation = p.getBasePositionAndOrientation(body, physicsClientId=self._client)
        velocity, turning = p.getBaseVelocity(body, physicsClientId=self._client)
        return position, rotation, velocity, turning

    def throw(self, body: int, velocity: Vec3, turning: Vec3) -> None:
        """Let the centre of mass of `body` move with `velocity` [m/s] and turn with `turning` [rad/s] from now on."""
        p.resetBaseVelocity(body, velocity, turning, physicsClientId=self._client)

    def rays(self, body: int, start: Sequence[Vec3], end: Sequence[Vec3]) -> NDArray[np.float64]:
        """How far each ray gets, as a part of its length: 1 when it hits nothing.

        `start` and `end` are in the frame of the body's centre of mass, see `ray_points`; the body itself is not hit.
        """
        hits = p.rayTestBatch(
            start,
            end,
            numThreads=1,
            parentObjectUniqueId=body,
            parentLinkIndex=-1,
            collisionFilterMask=_EVERYTHING ^ self._groups.get(body, 0),
            physicsClientId=self._client,
        )
        return np.fromiter((hit[2] for hit in hits), dtype=np.float64, count=len(hits))

    def ray_points(self, body: int, points: Sequence[Vec3]) -> list[Vec3]:
        """`points` of the body's frame as `rays` takes them."""
        below = self._below[body]
        return [(x + below[0], y + below[1], z + below[2]) for x, y, z in points]

    def touching(self, body: int) -> list[Contact]:
        """Where the shell of a vehicle touches something; its wheels and casters do not count."""
        points = p.getContactPoints(bodyA=body, linkIndexA=-1, physicsClientId=self._client)
        return [Contact(point[2], point[6]) for point in points or () if point[8] <= 0.0]

    def crowded(self, body: int, distance: float, *, but: int = -1) -> bool:
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
        """What a camera sees, drawn by pybullet's own slow software renderer: (height, width, 3) RGB.

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
        picture[np.reshape(depths, (height, width)) >= _NOTHING] = SKY
        return picture

    def show(self, at: Vec3) -> None:
        """Show in the window, if there is one, what was made so far, from behind and above the place `at` [m]."""
        if self._gui:
            client = self._client
            p.resetDebugVisualizerCamera(_WINDOW_AWAY, 0, -30, at, physicsClientId=client)
            p.configureDebugVisualizer(p.COV_ENABLE_RENDERING, 1, physicsClientId=client)

    def close(self) -> None:
        """Free the world; closing twice does nothing."""
        if self._client >= 0:
            with _quiet():
                p.disconnect(self._client)
            self._client = -1

    def add_looks(self, shape: Shape) -> int:
        """Something to see that nothing bumps into, for `picture`; its number."""
        visual = self._visual(shape, wanted=True)
        number = p.createMultiBody(
            0, -1, visual, shape.position, shape.rotation, physicsClientId=self._client
        )
        return int(number)

    def _collision(self, shape: Shape, offset: Vec3 = (0.0, 0.0, 0.0)) -> int:
        geometry = _geometry(shape)
        if "radius" in geometry and "length" in geometry:
            geometry["height"] = geometry.pop("length")
        number = p.createCollisionShape(
            **geometry, collisionFramePosition=offset, physicsClientId=self._client
        )
        return int(number)

    def _compound(self, shapes: Sequence[Shape]) -> int:
        """One collision shape made of boxes, straight cylinders and spheres, placed in the world's frame."""
        return int(
            p.createCollisionShapeArray(
                shapeTypes=[_geometry(shape)["shapeType"] for shape in shapes],
                radii=[shape.size[0] / 2 for shape in shapes],
                halfExtents=[[extent / 2 for extent in shape.size] for shape in shapes],
                lengths=[shape.size[2] for shape in shapes],
                collisionFramePositions=[shape.position for shape in shapes],
                collisionFrameOrientations=[shape.rotation for shape in shapes],
                physicsClientId=self._client,
            )
        )

    def _visual(self, shape: Shape, offset: Vec3 = (0.0, 0.0, 0.0), *, wanted: bool = False) -> int:
        if not (self._gui or wanted):
            return -1
        geometry = _geometry(shape)
        if "vertices" in geometry:
            geometry |= _surface(geometry["vertices"])
        colour = (*shape.colour, 1.0)
        number = p.createVisualShape(
            **geometry, rgbaColor=colour, visualFramePosition=offset, physicsClientId=self._client
        )
        return int(number)

    def _undamp(self, body: int) -> None:
        """Bullet's default damping is a drag that no robot has."""
        for link in range(-1, p.getNumJoints(body, physicsClientId=self._client)):
            p.changeDynamics(
                body,
                link,
                linearDamping=0,
                angularDamping=0,
                activationState=p.ACTIVATION_STATE_DISABLE_SLEEPING,
                physicsClientId=self._client,
            )

    def _set_wheels(self, body: int, spec: WheeledBody) -> None:
        wheels, steered = len(spec.wheels), len(spec.steered)
        knuckles = range(wheels, wheels + 2 * steered, 2)
        rolling = [*range(wheels), *(link + 1 for link in knuckles)]
        for link in rolling:
            p.changeDynamics(
                body, link, lateralFriction=spec.wheel_friction, jointDamping=0, physicsClientId=self._client
            )
        for link in knuckles:
            p.changeDynamics(
                body, link, localInertiaDiagonal=(_KNUCKLE,) * 3, jointDamping=0, physicsClientId=self._client
            )
        for link in rolling[wheels:]:
            p.setJointMotorControl2(body, link, p.VELOCITY_CONTROL, force=0, physicsClientId=self._client)
        for link in range(wheels + 2 * steered, p.getNumJoints(body, physicsClientId=self._client)):
            p.changeDynamics(body, link, lateralFriction=0, physicsClientId=self._client)


@dataclass(frozen=True, slots=True)
class _Link:
    """A part that hangs on a body by a joint."""

    position: Vec3
    """Relative to the parent's centre of mass [m]."""
    mass: float
    collision: int = -1
    kind: int = p.JOINT_REVOLUTE
    axis: tuple[int, int, int] = (0, 1, 0)
    parent: int = 0
    """0 the body itself, then the links from 1 on."""


def _less(a: Vec3, b: Vec3) -> Vec3:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _geometry(shape: Shape) -> dict[str, Any]:
    """The arguments that make `shape` in its own frame."""
    if shape.kind == "sphere":
        return {"shapeType": p.GEOM_SPHERE, "radius": shape.size[0] / 2}
    if shape.taper != (1.0, 1.0):
        plain = Shape(shape.kind, shape.size, taper=shape.taper)
        return {"shapeType": p.GEOM_MESH, "vertices": plain.corners()}
    if shape.kind == "cylinder":
        return {"shapeType": p.GEOM_CYLINDER, "radius": shape.size[0] / 2, "length": shape.size[2]}
    return {"shapeType": p.GEOM_BOX, "halfExtents": [extent / 2 for extent in shape.size]}


def _surface(points: Sequence[Vec3]) -> dict[str, Any]:
    """Triangles of the hull that `Shape.corners` spans, with a normal a corner, for drawing."""
    ring = len(points) // 2
    corners: list[Vec3] = []
    normals: list[Vec3] = []
    for i in range(ring):
        j = (i + 1) % ring
        side = (points[i], points[j], points[ring + j], points[ring + i])
        middle = ((side[0][0] + side[1][0]) / 2, (side[0][1] + side[1][1]) / 2, 0.0)
        _quad(side, middle, corners, normals)
    for base, up in ((0, -1.0), (ring, 1.0)):
        for i in range(1, ring - 1):
            corners += [points[base], points[base + i], points[base + i + 1]]
            normals += [(0.0, 0.0, up)] * 3
    return {"vertices": corners, "normals": normals, "indices": list(range(len(corners)))}


def _quad(side: Sequence[Vec3], outward: Vec3, corners: list[Vec3], normals: list[Vec3]) -> None:
    a, b, c, d = side
    length = max((outward[0] ** 2 + outward[1] ** 2) ** 0.5, 1e-9)
    normal = (outward[0] / length, outward[1] / length, 0.0)
    corners += [a, b, c, a, c, d]
    normals += [normal] * 6
