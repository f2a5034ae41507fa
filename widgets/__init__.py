"""Robot widgets for Kivy: a message becomes a picture, a finger becomes a message.

`from widgets import Compass` imports only the module that Compass needs. `CATALOGUE` tells which modules there are,
`python -m widgets` shows them all.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

CATALOGUE: dict[str, str] = {
    "ActionColumn": "widgets.action_column",
    "AckermannView": "widgets.ackermann",
    "ArmPanel": "widgets.arm_panel",
    "ArtificialHorizon": "widgets.horizon",
    "Battery": "widgets.battery",
    "CheckList": "widgets.check_list",
    "CommandedMotion": "widgets.commanded_motion",
    "Compass": "widgets.compass",
    "DepthGauge": "widgets.depth_gauge",
    "CourseDial": "widgets.course_dial",
    "EncodersView": "widgets.encoders",
    "EventLog": "widgets.event_log",
    "FieldView": "widgets.field_view",
    "GeoMap": "widgets.geo_map",
    "GoalPad": "widgets.goal_pad",
    "GridMap": "widgets.grid_map",
    "HandoverCard": "widgets.handover_card",
    "HeadingDial": "widgets.heading_dial",
    "HeadingTape": "widgets.heading_tape",
    "HeightTape": "widgets.height_tape",
    "IntentCard": "widgets.intent_card",
    "IntruderBadge": "widgets.intruder_badge",
    "Joystick": "widgets.joystick",
    "KeyHelp": "widgets.key_help",
    "LaserScanView": "widgets.laser_scan",
    "LegPanel": "widgets.leg_panel",
    "LiftLever": "widgets.lift_lever",
    "LineSensorView": "widgets.line_sensor",
    "LinkQuality": "widgets.link_quality",
    "ModeCard": "widgets.mode_card",
    "MissionList": "widgets.mission_list",
    "MotionSelector": "widgets.motion_selector",
    "OptionList": "widgets.option_list",
    "NoticeCard": "widgets.notice_card",
    "OrderForm": "widgets.order_form",
    "OrderQueue": "widgets.order_queue",
    "PadPicture": "widgets.pad_picture",
    "PausedCard": "widgets.paused_card",
    "PlaceForm": "widgets.place_form",
    "PlaceList": "widgets.place_list",
    "QuestionCard": "widgets.question_card",
    "Readout": "widgets.readout",
    "RollPitch": "widgets.roll_pitch",
    "RudderThrottle": "widgets.rudder_throttle",
    "ResetCard": "widgets.reset_card",
    "RotorSpeeds": "widgets.rotor_speeds",
    "RunList": "widgets.run_list",
    "ScheduleList": "widgets.schedule_list",
    "SlideToConfirm": "widgets.slide_confirm",
    "SonarRingView": "widgets.sonar_ring",
    "SpeedCap": "widgets.speed_cap",
    "StopAll": "widgets.stop_all",
    "StopButton": "widgets.stop_button",
    "StopList": "widgets.stop_list",
    "SusForm": "widgets.sus_form",
    "TaskButtons": "widgets.task_buttons",
    "TaskCard": "widgets.task_card",
    "TaskChooser": "widgets.task_chooser",
    "TiltCircle": "widgets.tilt_circle",
    "TlxScales": "widgets.tlx_scales",
    "UltrasoundView": "widgets.ultrasound",
    "Video": "widgets.video",
    "WhenPicker": "widgets.when_picker",
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
