"""Robot widgets for Kivy: a message becomes a picture, a finger becomes a message.

`from widgets import Compass` imports only the module that Compass needs. `CATALOGUE` tells which modules there are,
`python -m widgets` shows them all.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

CATALOGUE: dict[str, str] = {
    "ActionColumn": "widgets.controls.action_column",
    "AckermannView": "widgets.instruments.ackermann",
    "ArmPanel": "widgets.controls.goals.arm_panel",
    "ArtificialHorizon": "widgets.instruments.horizon",
    "Battery": "widgets.instruments.battery",
    "CheckList": "widgets.status.check_list",
    "CommandedMotion": "widgets.instruments.commanded_motion",
    "Compass": "widgets.instruments.compass",
    "DepthGauge": "widgets.instruments.depth_gauge",
    "CourseDial": "widgets.controls.course_dial",
    "EncodersView": "widgets.sensors.encoders",
    "EventLog": "widgets.status.event_log",
    "FieldView": "widgets.sensors.field_view",
    "GeoMap": "widgets.map.geo_map",
    "GoalPad": "widgets.controls.goals.goal_pad",
    "GridMap": "widgets.map.grid_map",
    "HandoverCard": "widgets.status.handover_card",
    "HeadingDial": "widgets.controls.heading_dial",
    "HeadingTape": "widgets.instruments.heading_tape",
    "HeightTape": "widgets.instruments.height_tape",
    "IntentCard": "widgets.status.intent_card",
    "IntruderBadge": "widgets.sensors.intruder_badge",
    "Joystick": "widgets.controls.joystick",
    "KeyHelp": "widgets.inputs.key_help",
    "LaserScanView": "widgets.sensors.laser_scan",
    "LegPanel": "widgets.instruments.leg_panel",
    "LiftLever": "widgets.controls.lift_lever",
    "LineSensorView": "widgets.sensors.line_sensor",
    "LinkQuality": "widgets.instruments.link_quality",
    "ModeCard": "widgets.status.mode_card",
    "MissionList": "widgets.tasks.mission_list",
    "MotionSelector": "widgets.controls.motion_selector",
    "OptionList": "widgets.parts.option_list",
    "NoticeCard": "widgets.status.notice_card",
    "OrderForm": "widgets.tasks.order_form",
    "OrderQueue": "widgets.tasks.order_queue",
    "PadPicture": "widgets.inputs.pad_picture",
    "PausedCard": "widgets.status.paused_card",
    "PlaceForm": "widgets.tasks.place_form",
    "PlaceList": "widgets.tasks.place_list",
    "QuestionCard": "widgets.status.question_card",
    "Readout": "widgets.instruments.readout",
    "RollPitch": "widgets.instruments.roll_pitch",
    "RudderThrottle": "widgets.controls.rudder_throttle",
    "ResetCard": "widgets.status.reset_card",
    "RotorSpeeds": "widgets.instruments.rotor_speeds",
    "RunList": "widgets.tasks.run_list",
    "ScheduleList": "widgets.tasks.schedule_list",
    "SlideToConfirm": "widgets.controls.slide_confirm",
    "SonarRingView": "widgets.sensors.sonar_ring",
    "SpeedCap": "widgets.controls.speed_cap",
    "StopAll": "widgets.controls.stop.stop_all",
    "StopButton": "widgets.controls.stop.stop_button",
    "StopList": "widgets.controls.stop.stop_list",
    "SusForm": "widgets.study.sus_form",
    "TaskButtons": "widgets.tasks.task_buttons",
    "TaskCard": "widgets.tasks.task_card",
    "TaskChooser": "widgets.tasks.task_chooser",
    "TiltCircle": "widgets.controls.tilt_circle",
    "TlxScales": "widgets.study.tlx_scales",
    "UltrasoundView": "widgets.sensors.ultrasound",
    "Video": "widgets.sensors.video",
    "WhenPicker": "widgets.tasks.when_picker",
}
"""Class name of each widget to the module that holds it; the module's `samples()` shows its states."""

__all__ = ["CATALOGUE", *CATALOGUE]  # noqa: PLE0604


def __getattr__(name: str) -> Any:
    """Import a widget's module when its class is first asked for."""
    if name not in CATALOGUE:
        raise AttributeError(f"module 'widgets' has no attribute {name!r}")
    return getattr(import_module(CATALOGUE[name]), name)


def __dir__() -> list[str]:
    return [*globals(), *CATALOGUE]
