"""Names and descriptions that a robot side of ours has of itself, by which the catalogues know them.

A robot says these in English. `tr` finds what stands here in the language of the glass; of another robot's words it
finds nothing, and they stay as they came.
"""

from __future__ import annotations

from widgets.core.language import mark, tr, within

__all__ = ["DESCRIPTIONS", "PAYLOADS", "ROBOTS", "ROLES", "WORLDS", "payload_title"]

PAYLOADS = {
    "robot": mark("Robot"),
    "wheels": mark("Wheels"),
    "camera": mark("Camera"),
    "laser": mark("Laser"),
    "sonar": mark("Sonar"),
    "ranges": mark("Ranges"),
    "bumper": mark("Bumper"),
    "line_sensor": mark("Line sensor"),
    "imu": mark("IMU"),
    "satellite": mark("Satellite"),
    "compass": mark("Compass"),
    "depth": mark("Depth"),
    "arm": mark("Arm"),
    "lights": mark("Lights"),
    "tag": mark("Tag reader"),
    "follower": mark("Follower"),
    "tasks": mark("Tasks"),
}
"""Key of each payload to what it is called."""
DESCRIPTIONS = (
    mark("who the robot is, how it is, STOP and control"),
    mark("driving by hand, and where the robot is"),
    mark("pictures, and what is recognised in them"),
    mark("a laser scanner"),
    mark("a ring of sonars"),
    mark("single distances by their echo"),
    mark("a bumper"),
    mark("the brightness of the ground"),
    mark("attitude and acceleration"),
    mark("position by satellite"),
    mark("a compass"),
    mark("a pressure gauge"),
    mark("an arm with a gripper"),
    mark("lights"),
    mark("a reader of cards"),
    mark("a sensor for who is guided"),
    mark("tasks, missions, places and the schedule"),
    mark("Who the robot is, STOP and control are always there."),
    mark("What pauses and ends a task has to be at hand."),
    mark("The laser keeps the robot off obstacles and tells it where it is."),
    mark("The bumper stops the robot where it touches something."),
    mark("It tells how the robot leans, by which its speed is limited."),
    mark("Without a laser the sonars keep the robot off obstacles."),
    mark("Without a laser the satellites tell where the robot is, and where its fence."),
    mark("Without a laser the compass tells where the robot looks."),
    mark("It tells how high or deep the robot is."),
    mark("topics to observe and commands by CoAP"),
    mark("topics and commands at a Kafka broker"),
    mark("topics and commands at an MQTT 5 broker"),
    mark("resources by HTTP on the robot's web site, with OpenAPI, streams and webhooks"),
    mark("web services with WSDL, on the robot's web site"),
    mark("plain JSON messages by WebSocket"),
)
"""What payloads and protocols are, and why one of them cannot be switched off."""
ROBOTS = (
    mark("Differential drive"),
    mark("Differential drive, sonars"),
    mark("Ackermann truck"),
    mark("Boat with rudder and throttle"),
    mark("Swimmer with six fins"),
    mark("Quadrotor"),
)
"""Descriptions of the robots that can be simulated."""
WORLDS = (mark("Lake"), mark("Office"), mark("Orchard"), mark("Parking lot"), mark("Tank"))
"""What the worlds of the simulator are called."""


ROLES = {
    "none": mark("nothing", "role"),
    "watch": mark("watch", "role"),
    "drive": mark("drive", "role"),
    "manage": mark("manage", "role"),
}
"""Word of each role of `bridge.core.identity` to what it is called."""


def payload_title(key: str) -> str:
    """What a payload or protocol is called on the glass; `line sensor` is written small within English alone."""
    return within(tr(PAYLOADS[key])) if key in PAYLOADS else key.replace("_", " ")
