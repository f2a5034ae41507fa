"""The table of payloads: every topic, service and action of a robot, each once, under what it belongs to."""

from __future__ import annotations

from bridge.core.topics import SONARS
from robotside.gateways.payloads.payload import Exchange, Payload

__all__ = ["ALWAYS", "KEYS", "PAYLOADS", "key_of"]

ALWAYS = "robot"
"""The payload that every gateway carries: who the robot is, STOP and control."""

_TWIST = '{"linear": {"x": 0.2}, "angular": {"z": 0.0}}'
_RANGE = "range [m], field_of_view [rad]"
_PICTURE = "data: a JPEG, as base64"
_POSE = "pose.pose.position [m], pose.pose.orientation as quaternion"


def _call(name: str, doc: str, example: str = "{}", units: str = "") -> Exchange:
    return Exchange(name, units, example, doc)


PAYLOADS: tuple[Payload, ...] = (
    Payload(
        ALWAYS,
        "who the robot is, how it is, STOP and control",
        (
            Exchange("/robot/info", "max_speed [m/s], max_yaw_rate [rad/s], radius [m]"),
            Exchange("/battery_state", "voltage [V], current [A], percentage [0 to 1]"),
            Exchange("/diagnostics"),
            Exchange("/events", "position [m]"),
            Exchange("/rosout"),
            Exchange("/checklist"),
            Exchange("/control/status", "speed_cap [0 to 1]"),
            _call("/stop", "stops the robot and keeps it at rest; from anyone, at any time"),
            _call("/stop/hold", "begins to release STOP; hold for a second, then call /stop/release"),
            _call("/stop/release", "releases STOP at the end of the hold"),
            _call("/control/acquire", "takes control"),
            _call("/control/release", "gives control back"),
            _call("/control/request", "asks the driver for control"),
            _call("/control/grant", "gives control to who asked for it"),
            _call("/control/object", "keeps control though somebody asked for it"),
            _call("/mode/set", "MANUAL pauses the task, AUTO resumes it", '{"mode": "MANUAL"}'),
            _call("/settings/set", "switches a setting", '{"name": "follow_link", "value": "on"}'),
            _call("/events/get", "the events after a number", '{"since": 0, "most": 20}'),
            _call("/events/picture", "the picture of the intruder that an event reports", '{"event": 1}'),
            _call("/events/acknowledge", "acknowledges events", '{"ids": [1]}'),
            Exchange("/gateways"),
            Exchange("/payloads"),
            _call(
                "/gateways/bring_up", "brings a protocol up; url empty is its usual one", '{"name": "mqtt"}'
            ),
            _call("/gateways/bring_down", "brings a protocol down", '{"name": "mqtt"}'),
            _call(
                "/payloads/set", "switches a payload on or off for everybody", '{"key": "lights", "on": true}'
            ),
            _call("/robot/reset", "puts a simulated robot back to its start"),
        ),
    ),
    Payload(
        "wheels",
        "driving by hand, and where the robot is",
        (
            Exchange("/cmd_vel", "linear [m/s], angular [rad/s]", _TWIST),
            Exchange(
                "/cmd_manoeuvre",
                "speed [m/s], steering [rad], roll [rad], pitch [rad], yaw [rad], height [m]",
                '{"kind": "rest"}',
            ),
            Exchange(
                "/goal_pose",
                "pose.position [m]",
                '{"header": {"frame_id": "map"}, "pose": {"position": {"x": 1.0, "y": 0.0}, "orientation": {"w": 1.0}}}',
            ),
            Exchange(
                "/initialpose",
                _POSE,
                '{"header": {"frame_id": "map"}, "pose": {"pose": {"position": {"x": 0.0}, "orientation": {"w": 1.0}}}}',
            ),
            _call("/localisation/choose", "tells the robot at which of its candidates it is", '{"id": 1}'),
            Exchange("/odom", f"{_POSE}, twist.twist.linear [m/s], twist.twist.angular [rad/s]"),
            Exchange("/pose", _POSE),
            Exchange("/localisation/candidates", "candidates.x [m], candidates.y [m], candidates.yaw [rad]"),
            Exchange("/tf", "transforms in metres, rotations as quaternions"),
            Exchange("/joint_states", "position [rad], velocity [rad/s]"),
            Exchange("/motors", "speeds [rad/s], torques [N m], temperatures [degC]"),
            Exchange("/manoeuvre", "speed [m/s], steering [rad]"),
            Exchange("/ackermann", "speed [m/s], steering [rad], turning_radius [m]"),
            Exchange("/rudder", "angle [rad], throttle [-1 to 1], thrust [N]"),
            Exchange("/flight", "height [m], climb [m/s]"),
            Exchange("/plan", "poses in metres"),
            Exchange("/sim/ground_truth", _POSE),
        ),
    ),
    Payload(
        "camera",
        "pictures, and what is recognised in them",
        (
            Exchange("/camera/image/compressed", _PICTURE),
            Exchange("/camera/rear/image/compressed", _PICTURE),
            Exchange("/camera/down/image/compressed", _PICTURE),
            Exchange("/detections", "boxes in pixels of the picture"),
            Exchange("/intruders", "intruders.position [m]"),
        ),
        sign="/detections",
    ),
    Payload(
        "laser",
        "a laser scanner",
        (Exchange("/scan", "ranges [m], angle_min [rad], angle_increment [rad]"),),
        sign="/scan",
    ),
    Payload(
        "sonar",
        "a ring of sonars",
        (
            Exchange("/sonar", "ranges [m], bearings [rad]"),
            *(Exchange(f"/sonar/{number}", _RANGE) for number in range(SONARS)),
        ),
        sign="/sonar",
    ),
    Payload(
        "ranges",
        "single distances by their echo",
        tuple(Exchange(f"/range/{where}", _RANGE) for where in ("front", "left", "right", "rear", "down")),
    ),
    Payload("bumper", "a bumper", (Exchange("/bumper", "bearing [rad]"),), sign="/bumper"),
    Payload(
        "line_sensor",
        "the brightness of the ground",
        (Exchange("/line_sensor", "values [0 to 1], spacing [m]"),),
        sign="/line_sensor",
    ),
    Payload(
        "imu",
        "attitude and acceleration",
        (Exchange("/imu/data", "angular_velocity [rad/s], linear_acceleration [m/s^2]"),),
        sign="/imu/data",
    ),
    Payload(
        "satellite",
        "position by satellite",
        (Exchange("/fix", "latitude [deg], longitude [deg], altitude [m]"),),
        sign="/fix",
    ),
    Payload("compass", "a compass", (Exchange("/compass", "heading [deg], roll [rad]"),), sign="/compass"),
    Payload("depth", "a pressure gauge", (Exchange("/depth", "fluid_pressure [Pa]"),), sign="/depth"),
    Payload(
        "arm",
        "an arm with a gripper",
        (
            Exchange("/arm", "angles [rad], wanted [rad], gripper [m], tip [m]"),
            _call(
                "/arm/move",
                "moves the arm to a named pose, a point, angles, by increments, or opens and closes its gripper",
                '{"order": {"pose": "home"}}',
                "order.point [m], order.pitch [rad], order.angles [rad], order.increments [rad], order.gripper [m]",
            ),
        ),
        sign="/arm",
    ),
    Payload(
        "lights",
        "lights",
        (
            Exchange("/lights", "brightness [0 to 1]"),
            _call(
                "/lights/set",
                "sets the brightness of the lights",
                '{"brightness": 1.0}',
                "brightness [0 to 1]",
            ),
        ),
        sign="/lights",
    ),
    Payload("tag", "a reader of cards", (Exchange("/tag"),), sign="/tag"),
    Payload(
        "follower",
        "a sensor for who is guided",
        (Exchange("/following", "distance [m]"),),
        sign="/following",
    ),
    Payload(
        "tasks",
        "tasks, missions, places and the schedule",
        (
            Exchange("/task/status"),
            Exchange("/task/progress", "progress [0 to 1], distance_to_next [m], time_left [s]"),
            Exchange("/task/queue"),
            Exchange("/mission", "dwell [s]"),
            Exchange("/schedule"),
            Exchange("/places", "places.x [m], places.y [m], places.yaw [rad]"),
            Exchange(
                "/limits",
                "max_speed [m/s], max_yaw_rate [rad/s], max_depth [m], max_height [m], floor [m], ceiling [m]",
            ),
            Exchange("/map", "info.resolution [m]"),
            _call("/task/start", "starts a task", '{"order": {"task": "go_home"}}', "order.speed [m/s]"),
            _call("/task/pause", "pauses the task"),
            _call("/task/resume", "resumes the task or the queue"),
            _call("/task/cancel", "ends the task"),
            _call("/task/confirm", "answers what the task asks"),
            _call("/task/go_home", "sends the robot home"),
            _call(
                "/task/queue/set",
                "replaces the tasks that wait",
                '{"revision": 0, "orders": [{"task": "go_home"}]}',
            ),
            Exchange(
                "/task/run", "", '{"order": {"task": "go_home"}}', "runs a task to its end, with feedback"
            ),
            _call("/mission/get", "the stored mission"),
            _call(
                "/mission/set",
                "stores a mission",
                '{"mission": {"waypoints": [{"x": 1.0, "y": 0.0}], "home": [{"x": 0.0, "y": 0.0}]}}',
                "mission.dwell [s]",
            ),
            _call("/missions/get", "the names of all missions that are kept"),
            _call("/mission/recall", "makes a kept mission the stored one", '{"name": "evening"}'),
            _call("/history/get", "the newest past tasks", '{"limit": 10}'),
            _call(
                "/places/set",
                "stores a place",
                '{"place": {"name": "Office 12", "x": 1.0, "y": 2.0}}',
                "place.x [m], place.y [m], place.yaw [rad]",
            ),
            _call("/places/delete", "deletes a place", '{"id": 1}'),
            _call(
                "/schedule/set",
                "stores a scheduled task",
                '{"task": {"at": "08:00", "order": {"task": "patrol"}}}',
            ),
            _call("/schedule/delete", "deletes a scheduled task", '{"id": 1}'),
        ),
    ),
)
"""Without the services of people and pairing, which are for who has a session of its own."""

KEYS = frozenset(payload.key for payload in PAYLOADS)
"""The key of each payload."""

_KEY_OF = {exchange.name: payload.key for payload in PAYLOADS for exchange in payload.exchanges}
_TEMPERATURE = "/temperature/"
"""Begins the topics of single motors, which each robot names as it likes."""


def key_of(name: str) -> str:
    """The key of the payload that a topic, service or action belongs to; empty for one of no payload."""
    return _KEY_OF.get(name) or ("wheels" if name.startswith(_TEMPERATURE) else "")
