"""Robot widgets for Kivy: a message becomes a picture, a finger becomes a message.

`from widgets import Compass` imports only the module that Compass needs. `CATALOGUE` tells which modules there are,
`python -m widgets` shows them all.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from widgets.controls.action_column import ActionColumn as ActionColumn
    from widgets.controls.course_dial import CourseDial as CourseDial
    from widgets.controls.goals.arm_panel import ArmPanel as ArmPanel
    from widgets.controls.goals.goal_pad import GoalPad as GoalPad
    from widgets.controls.heading_dial import HeadingDial as HeadingDial
    from widgets.controls.motion_selector import MotionSelector as MotionSelector
    from widgets.controls.signals.momentary_button import MomentaryButton as MomentaryButton
    from widgets.controls.signals.tick_box import TickBox as TickBox
    from widgets.controls.signals.toggle_switch import ToggleSwitch as ToggleSwitch
    from widgets.controls.slide_confirm import SlideToConfirm as SlideToConfirm
    from widgets.controls.speed_cap import SpeedCap as SpeedCap
    from widgets.controls.sticks.d_pad import DPad as DPad
    from widgets.controls.sticks.joystick import Joystick as Joystick
    from widgets.controls.sticks.lift_lever import LiftLever as LiftLever
    from widgets.controls.sticks.rudder_throttle import RudderThrottle as RudderThrottle
    from widgets.controls.sticks.tilt_circle import TiltCircle as TiltCircle
    from widgets.controls.stop.stop_all import StopAll as StopAll
    from widgets.controls.stop.stop_button import StopButton as StopButton
    from widgets.controls.stop.stop_list import StopList as StopList
    from widgets.fields.field_view import FieldView as FieldView
    from widgets.inputs.key_help import KeyHelp as KeyHelp
    from widgets.inputs.pad_picture import PadPicture as PadPicture
    from widgets.instruments.ackermann import AckermannView as AckermannView
    from widgets.instruments.battery import Battery as Battery
    from widgets.instruments.commanded_motion import CommandedMotion as CommandedMotion
    from widgets.instruments.compass import Compass as Compass
    from widgets.instruments.depth_gauge import DepthGauge as DepthGauge
    from widgets.instruments.heading_tape import HeadingTape as HeadingTape
    from widgets.instruments.height_tape import HeightTape as HeightTape
    from widgets.instruments.horizon import ArtificialHorizon as ArtificialHorizon
    from widgets.instruments.lamp import Lamp as Lamp
    from widgets.instruments.leg_panel import LegPanel as LegPanel
    from widgets.instruments.link_quality import LinkQuality as LinkQuality
    from widgets.instruments.readout import Readout as Readout
    from widgets.instruments.roll_pitch import RollPitch as RollPitch
    from widgets.instruments.rotor_speeds import RotorSpeeds as RotorSpeeds
    from widgets.instruments.turn_tape import TurnTape as TurnTape
    from widgets.map.geo_map import GeoMap as GeoMap
    from widgets.map.grid_map import GridMap as GridMap
    from widgets.parts.option_list import OptionList as OptionList
    from widgets.plots.plot import Plot as Plot
    from widgets.sensors.encoders import EncodersView as EncodersView
    from widgets.sensors.intruder_badge import IntruderBadge as IntruderBadge
    from widgets.sensors.laser_scan import LaserScanView as LaserScanView
    from widgets.sensors.line_sensor import LineSensorView as LineSensorView
    from widgets.sensors.sonar_ring import SonarRingView as SonarRingView
    from widgets.sensors.ultrasound import UltrasoundView as UltrasoundView
    from widgets.sensors.video import Video as Video
    from widgets.status.check_list import CheckList as CheckList
    from widgets.status.diagnostics_tree import DiagnosticsTree as DiagnosticsTree
    from widgets.status.event_log import EventLog as EventLog
    from widgets.status.handover_card import HandoverCard as HandoverCard
    from widgets.status.intent_card import IntentCard as IntentCard
    from widgets.status.mode_card import ModeCard as ModeCard
    from widgets.status.notice_card import NoticeCard as NoticeCard
    from widgets.status.paused_card import PausedCard as PausedCard
    from widgets.status.question_card import QuestionCard as QuestionCard
    from widgets.status.reset_card import ResetCard as ResetCard
    from widgets.status.where_card import WhereCard as WhereCard
    from widgets.study.sus_form import SusForm as SusForm
    from widgets.study.tlx_scales import TlxScales as TlxScales
    from widgets.tasks.mission_list import MissionList as MissionList
    from widgets.tasks.order_form import OrderForm as OrderForm
    from widgets.tasks.order_queue import OrderQueue as OrderQueue
    from widgets.tasks.place_form import PlaceForm as PlaceForm
    from widgets.tasks.place_list import PlaceList as PlaceList
    from widgets.tasks.run_list import RunList as RunList
    from widgets.tasks.schedule_list import ScheduleList as ScheduleList
    from widgets.tasks.task_buttons import TaskButtons as TaskButtons
    from widgets.tasks.task_card import TaskCard as TaskCard
    from widgets.tasks.task_chooser import TaskChooser as TaskChooser
    from widgets.tasks.when_picker import WhenPicker as WhenPicker

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
    "FieldView": "widgets.fields.field_view",
    "GeoMap": "widgets.map.geo_map",
    "GoalPad": "widgets.controls.goals.goal_pad",
    "GridMap": "widgets.map.grid_map",
    "HandoverCard": "widgets.status.handover_card",
    "HeadingDial": "widgets.controls.heading_dial",
    "HeadingTape": "widgets.instruments.heading_tape",
    "HeightTape": "widgets.instruments.height_tape",
    "IntentCard": "widgets.status.intent_card",
    "IntruderBadge": "widgets.sensors.intruder_badge",
    "Joystick": "widgets.controls.sticks.joystick",
    "KeyHelp": "widgets.inputs.key_help",
    "LaserScanView": "widgets.sensors.laser_scan",
    "LegPanel": "widgets.instruments.leg_panel",
    "LiftLever": "widgets.controls.sticks.lift_lever",
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
    "Plot": "widgets.plots.plot",
    "QuestionCard": "widgets.status.question_card",
    "Readout": "widgets.instruments.readout",
    "RollPitch": "widgets.instruments.roll_pitch",
    "RudderThrottle": "widgets.controls.sticks.rudder_throttle",
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
    "TiltCircle": "widgets.controls.sticks.tilt_circle",
    "TlxScales": "widgets.study.tlx_scales",
    "UltrasoundView": "widgets.sensors.ultrasound",
    "Video": "widgets.sensors.video",
    "WhenPicker": "widgets.tasks.when_picker",
    "WhereCard": "widgets.status.where_card",
    "DPad": "widgets.controls.sticks.d_pad",
    "ToggleSwitch": "widgets.controls.signals.toggle_switch",
    "TickBox": "widgets.controls.signals.tick_box",
    "MomentaryButton": "widgets.controls.signals.momentary_button",
    "Lamp": "widgets.instruments.lamp",
    "TurnTape": "widgets.instruments.turn_tape",
    "DiagnosticsTree": "widgets.status.diagnostics_tree",
}
"""Class name of each widget to the module that holds it; the module's `samples()` shows its states."""

__all__ = ["CATALOGUE", *CATALOGUE]  # noqa: PLE0604


if not TYPE_CHECKING:  # a name that the catalogue does not have is found by the type checker, too

    def __getattr__(name: str) -> Any:
        """Import a widget's module when its class is first asked for."""
        if name not in CATALOGUE:
            raise AttributeError(f"module 'widgets' has no attribute {name!r}")
        return getattr(import_module(CATALOGUE[name]), name)


def __dir__() -> list[str]:
    return [*globals(), *CATALOGUE]
