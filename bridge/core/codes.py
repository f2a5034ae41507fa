"""Codes of what happens and of why something is refused: what programs go by, so that none has to read a sentence."""

from __future__ import annotations

from enum import StrEnum
from typing import Self

__all__ = ["Code"]


class Code(StrEnum):
    """What an event, a refusal or a task's reason says, however it is worded.

    Each member is the code as it travels, its meaning, and the keys of its parameters. A code never gets another
    meaning; one that is no longer used stays reserved.
    """

    meaning: str
    """What is so, in a few words."""
    parameters: tuple[str, ...]
    """Keys of what its sentence names."""

    def __new__(cls, code: str, meaning: str, *parameters: str) -> Self:
        """A member of what stands behind its `=`."""
        member = str.__new__(cls, code)
        member._value_, member.meaning, member.parameters = code, meaning, parameters
        return member

    # STOP

    STOP_PRESSED = "stop_pressed", "The actor pressed STOP.", "name"
    STOP_RELEASED = "stop_released", "The actor released STOP.", "name"
    STOP_STILL_PRESSED = "stop_still_pressed", "STOP was pressed before the restart and still is.", "name"
    STOP_MOVES_ON = "stop_moves_on", "The robot hovers, floats up or drifts though STOP is pressed.", "robot"
    STOP_UNKEPT = "stop_unkept", "A restart would undo that STOP is pressed or released.", "state"
    STOP_KEPT = "stop_kept", "A restart would no longer undo that STOP is pressed or released.", "state"
    STOP_IS_PRESSED = "stop_is_pressed", "STOP has to be released first."
    STOP_UNSURE = "stop_unsure", "STOP is pressed and may not have reached the robot."
    STOP_NOT_HELD = "stop_not_held", "STOP is released by a hold of a second, which was not begun or is over."
    STOP_HELD_SHORT = "stop_held_short", "STOP was not held long enough to be released.", "seconds"
    STOP_RELEASED_LATELY = (
        "stop_released_lately",
        "STOP was released lately and cannot be again yet.",
        "seconds",
    )
    STOP_PRESSED_SINCE = "stop_pressed_since", "STOP was pressed after its release was requested."

    # trust

    TRUST_UNKNOWN = "trust_unknown", "The robot does not know who asks.", "operation"
    TRUST_ROLE = "trust_role", "The role of who asks is too small.", "operation", "role", "needed"
    TRUST_KEY = "trust_key", "The key is unknown, wrong or ended."
    TRUST_ATTEMPTS = "trust_attempts", "Too many attempts came from this address.", "seconds"
    TRUST_INSECURE = "trust_insecure", "It is done over TLS only."
    TRUST_PAIRING_CLOSED = "trust_pairing_closed", "Pairing is not open, or the link or code was used."
    TRUST_PAIRING_PAUSED = "trust_pairing_paused", "Too many wrong codes were given.", "seconds"
    TRUST_CODE_WRONG = "trust_code_wrong", "The code is wrong, or somebody is between."
    TRUST_NAME_INVALID = "trust_name_invalid", "The name is empty, too long or cannot be shown.", "max"
    TRUST_ROLE_INVALID = "trust_role_invalid", "Nobody can be given that role there.", "role"
    TRUST_DURATION_INVALID = "trust_duration_invalid", "The duration is not allowed.", "duration"
    TRUST_PERSON_UNKNOWN = "trust_person_unknown", "No one, or more than one, is called that.", "name"
    TRUST_FULL = "trust_full", "No more people can be known.", "max"
    TRUST_UNKEPT = "trust_unkept", "The list of people cannot be kept."
    PERSON_PAIRED = "person_paired", "The actor was paired.", "name", "role"
    PERSON_REMOVED = "person_removed", "A person was removed; its key opens nothing.", "name"
    PAIRING_OPENED = "pairing_opened", "Pairing is open for somebody.", "role"
    TRUST_PLAIN = "trust_plain", "Everybody in the network is let in without a key.", "role"

    # gateways

    GATEWAY_UP = "gateway_up", "The gateway reaches its broker.", "gateway"
    GATEWAY_LOST = (
        "gateway_lost",
        "The gateway does not reach its broker and tries again.",
        "gateway",
        "reason",
    )
    GATEWAY_REFUSED = (
        "gateway_refused",
        "The broker keeps a topic from the gateway, or does not take it.",
        "gateway",
        "topic",
    )
    GATEWAY_OPEN = (
        "gateway_open",
        "Everybody who reaches the gateway has a role without a key.",
        "gateway",
        "role",
    )
    GATEWAY_CALLBACK_LOST = (
        "gateway_callback_lost",
        "A client does not take its callbacks; its subscription has ended.",
        "gateway",
        "reason",
    )
    GATEWAY_NAMESAKE = (
        "gateway_namesake",
        "Another robot at the broker has the same name; both take STOP only.",
        "gateway",
        "name",
    )
    GATEWAY_UNDATED = "gateway_undated", "Nothing says how old the command is.", "operation"
    GATEWAY_RETAINED = "gateway_retained", "A command is not kept by a broker for later.", "operation"
    GATEWAY_CANCELLED = "gateway_cancelled", "The goal was taken back, or its client is gone.", "operation"
    GATEWAY_FULL = "gateway_full", "Too many clients use the gateway.", "max"
    GATEWAY_BUSY = "gateway_busy", "Too many requests wait for their turn.", "max"
    GATEWAY_STALE = "gateway_stale", "The request waited too long, or its client is gone."
    GATEWAY_LEFT_OUT = "gateway_left_out", "The gateway does not carry that.", "operation"
    GATEWAY_BROUGHT_UP = (
        "gateway_brought_up",
        "The actor brought a gateway up.",
        "name",
        "gateway",
        "endpoint",
    )
    GATEWAY_BROUGHT_DOWN = "gateway_brought_down", "The actor brought a gateway down.", "name", "gateway"
    GATEWAY_UNKNOWN = "gateway_unknown", "The robot knows no such protocol.", "gateway"
    GATEWAY_FIXED = "gateway_fixed", "The protocol always runs.", "gateway"
    GATEWAY_LACKING = (
        "gateway_lacking",
        "A library that the gateway needs is not installed.",
        "gateway",
        "package",
    )
    GATEWAY_URL_INVALID = "gateway_url_invalid", "The URL of the gateway is none.", "gateway"
    GATEWAY_PORT_TAKEN = "gateway_port_taken", "The port of the gateway is taken.", "gateway"
    GATEWAY_UNABLE = "gateway_unable", "The gateway cannot be brought up.", "gateway"
    GATEWAY_RUNS = "gateway_runs", "The gateway is up already.", "gateway"
    GATEWAY_DOWN = "gateway_down", "No gateway of that name is up.", "gateway"
    GATEWAY_OWN = "gateway_own", "The caller itself is connected by the gateway.", "gateway"

    # payloads

    PAYLOAD_SWITCHED = (
        "payload_switched",
        "The actor switched a payload on or off.",
        "name",
        "payload",
        "state",
    )
    PAYLOAD_OFF = "payload_off", "The payload is switched off.", "payload"
    PAYLOAD_UNKNOWN = "payload_unknown", "The robot has no such payload.", "payload"
    PAYLOAD_FIXED = "payload_fixed", "The payload is never switched off.", "payload"
    PAYLOAD_IN_USE = "payload_in_use", "The payload is in use.", "payload"

    WEBHOOK_FAILED = "webhook_failed", "A webhook's receiver takes no events.", "url", "reason"
    WEBHOOK_ADDRESS = "webhook_address", "Events are not sent to that address for who asks."

    # control

    CONTROL_TAKEN = "control_taken", "The actor has control.", "name"
    CONTROL_FREE = "control_free", "Control is free."
    CONTROL_LAPSED = "control_lapsed", "The actor was not heard and lost control.", "name", "seconds"
    CONTROL_ASKED = "control_asked", "The actor asks the driver for control.", "name", "driver", "seconds"
    CONTROL_OBJECTED = "control_objected", "The actor keeps control though somebody asked.", "name", "asker"
    CONTROL_HELD = "control_held", "The actor has control; only its holder may do that.", "name"
    CONTROL_HELD_ELSEWHERE = "control_held_elsewhere", "The same client_id has control elsewhere.", "name"
    CONTROL_ASKED_ALREADY = (
        "control_asked_already",
        "The actor has asked for control already.",
        "name",
        "driver",
    )
    CONTROL_OBJECTED_LATELY = "control_objected_lately", "The actor has objected lately.", "name", "seconds"
    CONTROL_OBJECTED_OFTEN = (
        "control_objected_often",
        "The driver has objected to the actor too often.",
        "name",
    )
    CONTROL_MANAGER_ASKS = (
        "control_manager_asks",
        "The actor manages the robot; a driver cannot object.",
        "name",
    )
    CONTROL_NOT_ASKED = "control_not_asked", "No one asks for control."
    MODE_MANUAL = "mode_manual", "The actor chose MANUAL: nothing starts by itself.", "name"
    MODE_UNKNOWN = "mode_unknown", "There is no such mode.", "mode"
    SETTING_CHANGED = "setting_changed", "The actor changed a setting.", "name", "setting", "value"
    SETTING_UNKNOWN = "setting_unknown", "There is no such setting.", "setting"
    SETTING_VALUE_UNKNOWN = "setting_value_unknown", "The setting has no such value.", "setting", "value"
    NOBODY_DRIVES = "nobody_drives", "No one drives the robot: it goes into its safe state.", "phase"

    # drive commands

    DRIVE_INVALID = "drive_invalid", "Its speeds are not all numbers."
    DRIVE_UNSTAMPED = "drive_unstamped", "It has no stamp and may be too old.", "age", "allowed"
    DRIVE_CLOCK_UNKNOWN = "drive_clock_unknown", "Its stamp is of a clock that was never compared."
    DRIVE_CLOCK_AHEAD = "drive_clock_ahead", "Its stamp is of the future.", "seconds"
    DRIVE_LATE = "drive_late", "It came too late.", "age", "allowed"
    DRIVE_OVERTAKEN = "drive_overtaken", "A newer one came before it."
    DRIVE_KIND_UNKNOWN = "drive_kind_unknown", "There is no such kind of manoeuvre.", "kind"
    DRIVE_UNABLE = "drive_unable", "The robot knows no such manoeuvre.", "robot", "kind"
    DRIVE_NOT_RELEASED = "drive_not_released", "The stick has to be released and pushed again."
    DRIVE_ON_GROUND = "drive_on_ground", "No stick starts the rotors; take_off does.", "robot"
    DRIVE_TOUCHES = "drive_touches", "The robot touches something there and is not pushed on."
    DRIVE_EXCESSIVE = (
        "drive_excessive",
        "More was asked for than the robot may.",
        "robot",
        "asked",
        "allowed",
        "quantity",
    )
    DRIVE_LEVEL = "drive_level", "The robot goes no higher or deeper.", "height"
    DRIVE_STEEP = "drive_steep", "It is too steep there for the robot."

    # where it is and where it may stand

    MAP_ARRIVED = "map_arrived", "There is a map now."
    MAP_MISSING = "map_missing", "There is no map of where the robot is."
    MAP_UNUSABLE = "map_unusable", "The map cannot be used."
    POSITION_PLACED = "position_placed", "The actor placed the robot on the map.", "name", "x", "y"
    POSITION_FOUND = "position_found", "The robot has found by itself that it is elsewhere.", "x", "y"
    POSITION_CANDIDATE_UNKNOWN = (
        "position_candidate_unknown",
        "The robot has no such candidate for its place any more.",
        "candidate",
    )
    POSITION_INVALID = "position_invalid", "The pose to place the robot at is not all numbers."
    POSITION_UNKNOWN = "position_unknown", "The robot's position is unknown."
    POSITION_LOST = (
        "position_lost",
        "No fix or compass: the robot assumes the map's origin.",
    )
    POSITION_UNSURE = "position_unsure", "The robot is not sure where it is."
    POSITION_UNSEEN = "position_unseen", "The laser meets too little to tell where the robot is."
    POSITION_SURE = "position_sure", "The robot is sure again where it is."
    POSITION_BY_WHEELS = "position_by_wheels", "The robot has no laser and reckons by its wheels."
    FENCE_LEFT = "fence_left", "The robot is outside its fence.", "x", "y"
    FENCE_HEIGHT_UNKNOWN = (
        "fence_height_unknown",
        "The height is unknown: the robot goes neither up nor down because of its fence.",
    )
    FENCE_NEAR = "fence_near", "The fence is near: the robot goes no nearer.", "room"
    FENCE_DRIFT = "fence_drift", "The robot is carried over its fence, or goes back from it.", "robot"
    FENCE_UNPLACED = "fence_unplaced", "The position is unknown, and so is the fence: the robot stays."
    FENCE_UNSURE = "fence_unsure", "The position is unsure, and so is the fence: the robot goes slowly."
    PLACE_OFF_MAP = "place_off_map", "The place is off the map.", "place", "x", "y"
    PLACE_IN_OBSTACLE = "place_in_obstacle", "The place is in an obstacle.", "place", "x", "y"
    PLACE_NEAR_OBSTACLE = "place_near_obstacle", "The place is too near to an obstacle.", "place", "x", "y"
    PLACE_OUTSIDE_FENCE = "place_outside_fence", "The place is outside the fence.", "place", "x", "y"
    PLACE_NEAR_FENCE = "place_near_fence", "The place is too near to the fence.", "place", "x", "y"

    # tasks

    TASK_STARTED = "task_started", "A task started.", "task"
    TASK_GOES_ON = "task_goes_on", "A task goes on that a restart cut.", "task"
    TASK_RESUMED = "task_resumed", "A paused task goes on.", "task"
    TASK_DONE = "task_done", "A task is done.", "task"
    TASK_FAILED = "task_failed", "A task failed.", "task"
    TASK_PLACE_UNSURE = (
        "task_place_unsure",
        "The robot is there as far as it knows, but unsure of its place: the task is not done.",
        "place",
    )
    TASK_PLACE_ASKED = (
        "task_place_asked",
        "The task waits until an operator says at which of its candidates the robot is.",
    )
    TASK_REPLACED = "task_replaced", "Another task was requested instead.", "task", "instead"
    TASK_INTERRUPTED = "task_interrupted", "A restart cut a task.", "task"
    TASK_STOPPED = "task_stopped", "The actor's STOP paused the task.", "name"
    TASK_PAUSED = "task_paused", "The actor paused the task.", "name"
    TASK_STAYS = (
        "task_stays",
        "The actor had the robot stay where it charges; the task is paused.",
        "name",
        "place",
    )
    TASK_TAKEN_OVER = "task_taken_over", "The actor's stick paused the task.", "name"
    TASK_LINK_LOST = "task_link_lost", "The lost link to the actor paused the task.", "name"
    TASK_OVERTURNED = "task_overturned", "The robot has turned over; the task is paused.", "robot"
    TASK_SENSOR_SILENT = "task_sensor_silent", "A sensor is silent; the task is paused."
    TASK_HELD_FAST = "task_held_fast", "Something holds the robot; the task is paused."
    TASK_BUMPED = "task_bumped", "The bumper touched something; the task is paused."
    TASK_INTRUDER = "task_intruder", "An intruder was found; the task is paused.", "id"
    TASK_ROBOT_LOST = "task_robot_lost", "The robot cannot be reached; the task is paused."
    TASK_CANCELED = "task_canceled", "The actor ended the task.", "name"
    TASK_DISCARDED = "task_discarded", "The actor discarded the task that a restart cut.", "name"
    TASK_ASKER_GONE = "task_asker_gone", "The actor, who started it, is gone; the task ended.", "name"
    TASK_RESET = "task_reset", "The actor put the robot back; the task ended.", "name"
    TASK_ROBOT_ENDS = "task_robot_ends", "The robot's program ends, and the task with it."
    TASK_FAULT = "task_fault", "A fault of the robot's program ended the task.", "fault"
    TASK_BATTERY = "task_battery", "The battery is low and home cannot be reached; the task ended.", "charge"
    TASK_LOOP_LATE = "task_loop_late", "The robot's computer lags too much: the task waits."
    TASK_SLOW = "task_slow", "Something took too long; the robot stays where it is.", "seconds"
    TASK_EDITED = "task_edited", "The patrol goes on with a new mission.", "count"
    WAY_BLOCKED = "way_blocked", "The way is blocked.", "place", "x", "y"
    WAY_MISSING = "way_missing", "There is no way to the place."
    WAY_ENDED = "way_ended", "The way straight on ended.", "x", "y"
    HEIGHT_UNREACHED = "height_unreached", "The height is not reached.", "height", "reached"
    DOCK_DEAD = "dock_dead", "The dock gives no charge: the contacts meet, but no current flows.", "place"
    DOCK_UNSEEN = "dock_unseen", "The dock is not seen where it should be.", "place"
    DOCK_TAGS_UNREAD = (
        "dock_tags_unread",
        "The dock is found by its tag alone, and the library that reads tags is not installed.",
        "place",
    )
    DOCK_TAKEN = "dock_taken", "Something stands in the dock.", "place"
    DOCK_BLOCKED = "dock_blocked", "Something stands before the dock.", "place"
    DOCK_MISSED = "dock_missed", "The contacts of robot and dock did not meet.", "place"
    UNDOCK_BLOCKED = "undock_blocked", "The robot cannot leave the dock.", "place"
    CHARGING = "charging", "The robot charges and goes on with enough.", "place", "charge", "until"
    CHARGE_LOST = "charge_lost", "The dock charges no more.", "place", "charge"
    CHARGE_UNKNOWN = (
        "charge_unknown",
        "The battery is silent: whether it charges is not known.",
        "place",
        "seconds",
    )
    CHARGE_NEEDED = "charge_needed", "There is too little charge to go on with.", "charge", "needed"
    CHARGE_CUT = "charge_cut", "Somebody had the robot go on before its battery had enough.", "name", "charge"
    WAYPOINT_REACHED = "waypoint_reached", "A point or place was reached.", "place"
    WAYPOINT_SKIPPED = "waypoint_skipped", "A point cannot be reached and is skipped.", "place"
    MESSAGE_TOLD = "message_told", "The robot tells the message of its task.", "place", "message"
    FOLLOWER_LOST = "follower_lost", "Nobody follows; the robot waits.", "place"
    FOLLOWER_BACK = "follower_back", "Somebody follows again.", "place"
    FOLLOWER_UNKNOWN = "follower_unknown", "Nothing tells whether somebody follows."
    ANSWER_GIVEN = "answer_given", "Somebody confirmed what the task asked.", "name", "place"
    ANSWER_BY_CARD = "answer_by_card", "A card confirmed what the task asked.", "place"
    CARD_UNKNOWN = "card_unknown", "No card can answer there.", "place"
    CARD_WRONG = "card_wrong", "The card is not the one that answers there.", "place"
    INTRUDER_FOUND = "intruder_found", "An intruder was found.", "id", "kind", "x", "y"
    INTRUDER_CIRCLED = (
        "intruder_circled",
        "The robot went round an intruder, and saw so many of the sides; the others are named.",
        "id",
        "sides",
        "count",
        "missing",
    )
    BATTERY_LOW = "battery_low", "The battery is low.", "charge"
    BATTERY_GOING_HOME = "battery_going_home", "The battery is low: the robot goes home.", "charge"
    BATTERY_GOING_TO_DOCK = (
        "battery_going_to_dock",
        "The battery is low: the robot goes to charge.",
        "place",
        "charge",
    )
    BUMPER_TOUCHED = "bumper_touched", "The bumper touched something.", "side"

    # queue and schedule

    QUEUE_HELD = "queue_held", "The queue waits until somebody has it go on.", "count"
    QUEUE_ADDED = "queue_added", "A scheduled task waits in the queue.", "task"
    QUEUE_LEFT_OUT = "queue_left_out", "A task of the queue cannot be done and is left out.", "task"
    SCHEDULE_SKIPPED = "schedule_skipped", "A scheduled task is skipped.", "task"
    SCHEDULE_TIME_MISSING = (
        "schedule_time_missing",
        "It needs a time of day, a period, not both and not none.",
    )
    SCHEDULE_DAY_MISSING = "schedule_day_missing", "It needs a day of the week."
    SCHEDULE_TIME_INVALID = "schedule_time_invalid", "The time of day is none.", "at"
    SCHEDULE_PERIOD_INVALID = "schedule_period_invalid", "The period is too short or too long.", "period"
    SCHEDULE_UNKNOWN = "schedule_unknown", "There is no such scheduled task.", "id"
    QUEUE_CHANGED = "queue_changed", "The queue has changed meanwhile.", "revision"
    QUEUE_WRONG = "queue_wrong", "Tasks of the queue are unknown or named twice."

    # missions

    MISSION_STORED = "mission_stored", "A mission was stored.", "count"
    MISSION_EMPTY = "mission_empty", "The mission has no points."
    MISSION_UNKNOWN = "mission_unknown", "There is no such mission.", "mission"
    MISSION_TOO_LONG = "mission_too_long", "The mission has too many points.", "count", "max"
    MOTION_UNKNOWN = "motion_unknown", "There is no such motion.", "motion"
    REACTION_UNKNOWN = "reaction_unknown", "There is no such reaction to an intruder.", "reaction"
    CLASS_UNKNOWN = "class_unknown", "There is no such class of intruders.", "kind"
    DWELL_INVALID = "dwell_invalid", "The dwell is not allowed.", "dwell", "max"
    LAPS_INVALID = "laps_invalid", "The number of laps is not allowed.", "laps", "max"

    # why a task is refused

    TASK_UNKNOWN = "task_unknown", "There is no such task.", "task"
    TASK_UNABLE = "task_unable", "The robot does not know the task.", "robot", "task"
    TASK_ACTIVE = "task_active", "Another task has not ended.", "state"
    TASK_NONE_RUNNING = "task_none_running", "No task is running."
    TASK_NONE_PAUSED = "task_none_paused", "No task is paused."
    TASK_NONE_LEFT = "task_none_left", "There is no task to go on with."
    TASK_ASKS_NOTHING = "task_asks_nothing", "The robot asks nothing."
    BATTERY_TOO_LOW = "battery_too_low", "The battery is too low for the task.", "task", "charge", "needed"
    SENSORS_SILENT = "sensors_silent", "Sensors are silent: the robot can be driven by hand only."
    ROBOT_OVERTURNED = "robot_overturned", "The robot has turned over.", "robot"
    HOME_UNSET = "home_unset", "Home is not set."
    HEADING_INVALID = "heading_invalid", "The heading is no number.", "heading"
    SPEED_INVALID = "speed_invalid", "The speed is not allowed.", "speed", "max"
    THROTTLE_INVALID = "throttle_invalid", "The throttle is not allowed.", "throttle"
    HEIGHT_UNUSED = "height_unused", "The robot keeps no height.", "robot"
    HEIGHT_INVALID = "height_invalid", "The height is not allowed.", "height", "lowest", "highest"
    DURATION_INVALID = "duration_invalid", "The duration is not allowed.", "duration", "max"
    DOCK_MISSING = "dock_missing", "There is no dock."
    CHARGE_INVALID = "charge_invalid", "The charge to stay for is not allowed.", "charge", "least"
    DOCK_UNDIRECTED = "dock_undirected", "The dock has no direction.", "place"
    PLACES_MISCOUNTED = "places_miscounted", "The task needs another number of places.", "count"
    PLACES_TOO_MANY = "places_too_many", "The task names too many places.", "count", "max"
    PLACE_UNKNOWN = "place_unknown", "There is no such place.", "place"

    # what is kept

    PLACE_UNNAMED = "place_unnamed", "The place has no name."
    PLACE_NAME_TAKEN = "place_name_taken", "Another place has that name.", "place"
    PLACE_ID_UNKNOWN = "place_id_unknown", "There is no place with that number.", "id"
    PLACE_KIND_UNKNOWN = "place_kind_unknown", "There is no such kind of place.", "kind"
    PLACE_INVALID = "place_invalid", "The place's x and y are not numbers."
    PLACES_TAKEN_OVER = "places_taken_over", "The places of the world were taken over.", "count"
    PLACES_LEFT_OUT = "places_left_out", "Not all places of the world could be taken over."
    PICTURE_MISSING = "picture_missing", "There is no picture with the event.", "id"
    EVENT_UNKNOWN = "event_unknown", "There is no event with that number.", "id"
    EVENTS_TOO_MANY = "events_too_many", "Too many events at once.", "count", "max"
    HISTORY_RANGE_INVALID = (
        "history_range_invalid",
        "The range of the history is not allowed.",
        "before",
        "limit",
    )
    RECORDS_FULL = "records_full", "No more of them can be stored.", "max"
    RECORDS_DAMAGED = "records_damaged", "Something is wrong with what was kept."
    RECORDS_UNWRITTEN = "records_unwritten", "The database cannot be written, or does not answer."
    RECORDS_WRITTEN = "records_written", "The database can be written again."

    # commands

    COMMAND_LATE = "command_late", "The command came too late.", "age", "allowed"
    COMMAND_AHEAD = "command_ahead", "The command's stamp is of the future.", "seconds", "allowed"
    COMMAND_ID_INVALID = "command_id_invalid", "The command_id is too long.", "length", "max"

    # the robot itself

    ROBOT_UNREACHABLE = "robot_unreachable", "The robot cannot be reached, or not be driven."
    ROBOT_BACK = "robot_back", "The robot can be driven again."
    ROBOT_RESET = "robot_reset", "The actor put the robot back to its start.", "name", "robot", "x", "y"
    ROBOT_KIND_UNKNOWN = "robot_kind_unknown", "The robot's kind is not known.", "kind"
    ROBOT_FAULT = "robot_fault", "The robot's program has a fault.", "fault"
    ROBOT_SUNK = "robot_sunk", "The robot has sunk.", "robot"
    ROBOT_ASTRAY = "robot_astray", "The robot has left its world.", "robot", "world"
    ROBOT_BESIDE_START = (
        "robot_beside_start",
        "There is no room at its start: it stands beside it.",
        "robot",
        "aside",
    )
    ORDER_CUT = "order_cut", "An order was cut to what the robot can do.", "robot"
    FOREIGN_REMARK = "foreign_remark", "Something to know of a robot with another program."
    CAMERA_UNREADABLE = "camera_unreadable", "The camera's pictures cannot be shown.", "format"
    EQUIPMENT_REFUSED = "equipment_refused", "The robot's own part refuses it."
    ARM_GOAL_MISSING = "arm_goal_missing", "Nothing says where the arm shall go."
    ARM_REPLACED = "arm_replaced", "The actor gave the arm another order before it was there.", "name"
    ARM_HELD = "arm_held", "The arm was held before it was there."
    ARM_LATE = "arm_late", "The arm was not there in time.", "allowed"

    SIMULATION_SLOW = (
        "simulation_slow",
        "The simulation is slower than real time; the robot goes slower or rests.",
        "factor",
        "seconds",
    )
    LOOP_LATE = "loop_late", "The robot's control loop is late; the robot goes slower or rests.", "seconds"
    LOOP_ON_TIME = "loop_on_time", "The robot's loop, or its simulation, keeps up again."

    # the checks before the first motion

    CHECK_BATTERY_GOOD = "check_battery_good", "The battery is charged."
    CHECK_BATTERY_LOW = "check_battery_low", "The battery has less than is needed.", "needed"
    CHECK_BATTERY_UNKNOWN = "check_battery_unknown", "The battery has not reported its charge."
    CHECK_SENSORS_GOOD = "check_sensors_good", "All sensors are alive."
    CHECK_SENSORS_SILENT = "check_sensors_silent", "Sensors are silent.", "sensors"
    CHECK_POSITION_GOOD = "check_position_good", "The robot knows where it is."
    CHECK_POSITION_UNKNOWN = "check_position_unknown", "The robot has no place on the map."
    CHECK_POSITION_UNSURE = "check_position_unsure", "The robot is not sure of its place."
    CHECK_STOP_GOOD = "check_stop_good", "STOP was tested."
    CHECK_STOP_UNTESTED = "check_stop_untested", "STOP was not tested since the start."
    CHECK_CLOCK_GOOD = "check_clock_good", "The clocks agree."
    CHECK_CLOCK_UNKNOWN = "check_clock_unknown", "No handheld has sent its clock."
    CHECK_CLOCK_AHEAD = "check_clock_ahead", "The handheld's clock is ahead of the robot's.", "seconds"
    CHECK_CLOCK_BEHIND = "check_clock_behind", "The handheld's clock is behind the robot's.", "seconds"

    # the handheld

    DRAWING_SLOW = (
        "drawing_slow",
        "The handheld draws fewer frames than usual, for each takes it long.",
        "seconds",
    )
    DRAWING_FAST = "drawing_fast", "The handheld draws as many frames as usual again.", "seconds"
