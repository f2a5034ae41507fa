"""Specifications of rigid bodies for the physics engine, and the states that it gives back."""

from __future__ import annotations

import math
from dataclasses import dataclass

from sim.core.shapes import Quat, Shape, Vec3

__all__ = ["Contact", "Floating", "Joint", "State", "WheeledBody"]


@dataclass(frozen=True, slots=True)
class State:
    """Pose and motion of a body, in the world's frame."""

    position: Vec3
    """Of its frame's origin [m]."""
    rotation: Quat
    velocity: Vec3
    """Of its centre of mass [m/s]."""
    turning: Vec3
    """[rad/s]"""


@dataclass(frozen=True, slots=True)
class Joint:
    """A wheel's joint."""

    angle: float
    """[rad], not wrapped."""
    speed: float
    """[rad/s]"""
    torque: float
    """That its motor gave in the last step [N m]."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A place where a vehicle's shell touches something."""

    body: int
    """Number of the body that it touches."""
    position: Vec3
    """In the world's frame [m]."""


@dataclass(frozen=True, slots=True)
class WheeledBody:
    """A body on driven wheels and casters; its frame lies on the ground, x forward."""

    shell: Shape
    mass: float
    """Of the whole without wheels and casters [kg]."""
    inertia: Vec3
    """About the axes through the centre of mass [kg m2]."""
    centre_of_mass: Vec3
    friction: float
    """Of the shell against other things."""
    wheels: tuple[Vec3, ...] = ()
    """Centres of the driven wheels; they turn about y."""
    wheel_radius: float = 0.0
    wheel_mass: float = 0.0
    wheel_friction: float = 0.0
    """As a part of the ground's."""
    casters: tuple[Vec3, ...] = ()
    """Centres of the casters, which slide without friction."""
    caster_radius: float = 0.0
    caster_mass: float = 0.0

    @property
    def radius(self) -> float:
        """Of a sphere about its centre of mass that all of it fits in [m]."""
        com = self.centre_of_mass
        rolling = (math.dist(centre, com) + self.wheel_radius for centre in self.wheels)
        sliding = (math.dist(centre, com) + self.caster_radius for centre in self.casters)
        return max(math.dist(self.shell.position, com) + self.shell.radius, *rolling, *sliding)


@dataclass(frozen=True, slots=True)
class Floating:
    """A single free body, which a vehicle's own model moves by the force and torque of each step."""

    shell: Shape
    """In the body's frame."""
    mass: float
    """[kg]"""
    inertia: Vec3
    """About the axes through the centre of mass [kg m2]."""
    centre_of_mass: Vec3
    friction: float
    """Against other things."""

    @property
    def radius(self) -> float:
        """Of a sphere about its centre of mass that it fits in [m]."""
        return math.dist(self.shell.position, self.centre_of_mass) + self.shell.radius
