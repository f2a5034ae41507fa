"""Rigid bodies of the physics engine: the ground, fixed things, free bodies and wheeled vehicles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sim.core.shapes import Quat, Shape, Vec3, place
from sim.physics.bodies import Floating, WheeledBody
from sim.physics.bullet_shapes import collision, compound, visual
from sim.physics.quiet_pybullet import p

__all__ = ["BodyMaker"]

_MAX_SOLIDS = 16
"""Of a thing; pybullet leaves out any more without a warning."""
_NO_JOINTS = 1
"""Of a fixed thing; pybullet would else take it for a robot without joints and include it in every step."""
_OF_THE_OTHER = 1.0
"""Friction of a fixed thing: the engine multiplies that of two bodies, so that on it every body has its own, not half of it."""


@dataclass(frozen=True, slots=True)
class _Link:
    """A part that hangs on a body by a joint."""

    position: Vec3
    """Relative to the parent's centre of mass [m]."""
    mass: float
    collision: int = -1
    kind: int = p.JOINT_REVOLUTE


class BodyMaker:
    """Makes bodies in one world of the engine; every method returns the number of the new body."""

    def __init__(self, client: int, *, visible: bool) -> None:
        """Bodies of the world `client`; they have visual shapes only when it is `visible` in the engine's window."""
        self._client, self._visible = client, visible

    def ground(self, height: float, grip: float) -> int:
        """The level ground at z = `height` [m], on which a body has its own friction times `grip`."""
        shape = p.createCollisionShape(p.GEOM_PLANE, physicsClientId=self._client)
        looks = -1
        if not self._visible:  # Bullet would else keep 10 MB of a chequered plane that is never seen
            speck = (0.001, 0.001, 0.001)
            looks = p.createVisualShape(p.GEOM_BOX, halfExtents=speck, physicsClientId=self._client)
        ground = int(
            p.createMultiBody(
                0,
                shape,
                looks,
                basePosition=(0, 0, height),
                useMaximalCoordinates=_NO_JOINTS,
                physicsClientId=self._client,
            )
        )
        p.changeDynamics(ground, -1, lateralFriction=grip, physicsClientId=self._client)
        return ground

    def static(self, shapes: Sequence[Shape]) -> int:
        """One thing made of solids that nothing moves; of one with many solids, the number of its first part."""
        if len(shapes) > 1 and any(shape.is_tapered for shape in shapes):
            # of a thing with several solids the engine leaves out those that are tapered, and says nothing
            straight = [shape for shape in shapes if not shape.is_tapered]
            parts = [straight, *([shape] for shape in shapes if shape.is_tapered)]
            numbers = [self.static(part) for part in parts if part]
            return numbers[0]
        if len(shapes) > _MAX_SOLIDS:
            first = self.static(shapes[:_MAX_SOLIDS])
            self.static(shapes[_MAX_SOLIDS:])
            return first
        if len(shapes) == 1:
            shape = shapes[0]
            number, pose = collision(self._client, shape), (shape.position, shape.rotation)
        else:
            number, pose = compound(self._client, shapes), ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
        body = p.createMultiBody(
            0, number, -1, *pose, useMaximalCoordinates=_NO_JOINTS, physicsClientId=self._client
        )
        p.changeDynamics(body, -1, lateralFriction=_OF_THE_OTHER, physicsClientId=self._client)
        if self._visible:
            for shape in shapes:
                self.looks(shape)
        return int(body)

    def looks(self, shape: Shape) -> int:
        """A visual shape alone, which collides with nothing."""
        number = visual(self._client, shape)
        return int(
            p.createMultiBody(0, -1, number, shape.position, shape.rotation, physicsClientId=self._client)
        )

    def single(self, shape: Shape, mass: float) -> int:
        """A free rigid body of one `shape` and `mass` [kg]."""
        body = int(
            p.createMultiBody(
                mass,
                collision(self._client, shape),
                self._visual(shape),
                shape.position,
                shape.rotation,
                physicsClientId=self._client,
            )
        )
        self._undamp(body)
        return body

    def wheeled(self, spec: WheeledBody, position: Vec3, rotation: Quat) -> int:
        """A wheeled vehicle, its joints in the order that `Bullet.add_wheeled` gives."""
        com = spec.centre_of_mass
        links: list[_Link] = []
        if spec.wheels:
            wheel = collision(self._client, Shape("sphere", (2 * spec.wheel_radius,) * 3))
            links += [_Link(_less(centre, com), spec.wheel_mass, wheel) for centre in spec.wheels]
        if spec.casters:
            caster = collision(self._client, Shape("sphere", (2 * spec.caster_radius,) * 3))
            links += [
                _Link(_less(centre, com), spec.caster_mass, caster, kind=p.JOINT_FIXED)
                for centre in spec.casters
            ]
        body = self._moving(spec, links, position, rotation)
        self._set_wheels(body, spec)
        return body

    def floating(self, spec: Floating, position: Vec3, rotation: Quat) -> int:
        """A single free body without joints."""
        return self._moving(spec, [], position, rotation)

    def _moving(
        self, spec: WheeledBody | Floating, links: list[_Link], position: Vec3, rotation: Quat
    ) -> int:
        com = spec.centre_of_mass
        offset = _less(spec.shell.position, com)
        body = int(
            p.createMultiBody(
                baseMass=spec.mass,
                baseCollisionShapeIndex=collision(self._client, spec.shell, offset),
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
                linkParentIndices=[0] * len(links),
                linkJointTypes=[link.kind for link in links],
                linkJointAxis=[(0, 1, 0)] * len(links),
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
        return body

    def _visual(self, shape: Shape, offset: Vec3 = (0.0, 0.0, 0.0)) -> int:
        return visual(self._client, shape, offset) if self._visible else -1

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
        wheels = len(spec.wheels)
        for link in range(p.getNumJoints(body, physicsClientId=self._client)):
            friction = spec.wheel_friction if link < wheels else 0.0
            p.changeDynamics(
                body, link, lateralFriction=friction, jointDamping=0, physicsClientId=self._client
            )


def _less(a: Vec3, b: Vec3) -> Vec3:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])
