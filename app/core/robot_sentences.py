"""The robot's sentences in other languages than English, chosen by their codes and filled with their parameters.

A robot writes English. What has a code of `bridge.core.codes` is said anew in the language of the glass; what has none, or
lacks a value that its sentence names, stays in the robot's own words. So does everything where the glass speaks English,
but for what has a figure in a unit that the operator has chosen another one for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from app.core.robot_docs import ROLES, payload_title
from bridge.core.codes import Code
from bridge.core.units import quantity_of
from bridge.msgs.diagnostic_msgs import KeyValue
from widgets.core.detected import kind_word
from widgets.core.language import language, mark, tr
from widgets.core.quantities import quantities, quantity_words
from widgets.core.task_words import TASKS

__all__ = ["SENTENCES", "sentence"]

SENTENCES: Mapping[str, str] = {
    Code.STOP_PRESSED: mark("STOP pressed by {name}."),
    Code.STOP_RELEASED: mark("STOP released by {name}."),
    Code.STOP_STILL_PRESSED: mark("STOP was pressed by {name} before the restart and still is."),
    Code.STOP_MOVES_ON: mark("{robot} does not rest though STOP is pressed: it hovers, floats up or drifts."),
    Code.STOP_IS_PRESSED: mark("STOP is pressed; hold Release to drive again."),
    Code.STOP_UNSURE: mark("STOP is pressed and may not have reached the robot."),
    Code.STOP_NOT_HELD: mark("STOP stays: hold Release again."),
    Code.STOP_HELD_SHORT: mark("STOP stays: hold Release {seconds} longer."),
    Code.STOP_RELEASED_LATELY: mark("STOP was released just now and cannot be again for {seconds}."),
    Code.STOP_PRESSED_SINCE: mark("STOP was pressed after this request: it stays."),
    Code.TRUST_UNKNOWN: mark("The robot does not know this handheld: pair with it."),
    Code.TRUST_ROLE: mark("That needs the role {needed}; this handheld has {role}."),
    Code.TRUST_KEY: mark("The robot does not take this handheld's key any more: pair again."),
    Code.TRUST_ATTEMPTS: mark("Too many attempts: wait {seconds}."),
    Code.TRUST_INSECURE: mark("That is done over a protected link only."),
    Code.TRUST_PAIRING_CLOSED: mark("Pairing is not open, or the link or code was used."),
    Code.TRUST_PAIRING_PAUSED: mark("Too many wrong codes: wait {seconds}."),
    Code.TRUST_CODE_WRONG: mark("The code is wrong, or somebody is between."),
    Code.TRUST_NAME_INVALID: mark("A name has 1 to {max} characters that can be shown."),
    Code.TRUST_PERSON_UNKNOWN: mark("No one, or more than one, is called {name}."),
    Code.TRUST_FULL: mark("No more than {max} people can be known."),
    Code.TRUST_UNKEPT: mark("The list of people cannot be kept."),
    Code.PERSON_PAIRED: mark("{name} was paired."),
    Code.PERSON_REMOVED: mark("{name} was removed; its key opens nothing."),
    Code.PAIRING_OPENED: mark("Pairing is open for somebody."),
    Code.TRUST_PLAIN: mark("Everybody in this network is let in without a key."),
    Code.GATEWAY_UP: mark("{gateway}: its broker is reached again."),
    Code.GATEWAY_LOST: mark("{gateway}: its broker is not reached."),
    Code.GATEWAY_OPEN: mark("{gateway}: everybody who reaches it is let in without a key."),
    Code.GATEWAY_NAMESAKE: mark("{gateway}: another robot there is called {name} too; both take STOP only."),
    Code.GATEWAY_BROUGHT_UP: mark("{name} brought {gateway} up."),
    Code.GATEWAY_BROUGHT_DOWN: mark("{name} brought {gateway} down."),
    Code.GATEWAY_UNKNOWN: mark("The robot knows no protocol {gateway}."),
    Code.GATEWAY_FIXED: mark("{gateway} always runs."),
    Code.GATEWAY_LACKING: mark("{gateway} needs {package}, which the robot lacks."),
    Code.GATEWAY_URL_INVALID: mark("The address of {gateway} is none."),
    Code.GATEWAY_PORT_TAKEN: mark("The port of {gateway} is taken."),
    Code.GATEWAY_UNABLE: mark("{gateway} cannot be brought up."),
    Code.GATEWAY_RUNS: mark("{gateway} is up already."),
    Code.GATEWAY_DOWN: mark("{gateway} is not up."),
    Code.PAYLOAD_SWITCHED: mark("{name} switched {payload}: {state}."),
    Code.PAYLOAD_OFF: mark("{payload} is switched off."),
    Code.PAYLOAD_UNKNOWN: mark("The robot has no {payload}."),
    Code.PAYLOAD_FIXED: mark("{payload} stays on."),
    Code.PAYLOAD_IN_USE: mark("{payload} is in use."),
    Code.CONTROL_TAKEN: mark("{name} has control."),
    Code.CONTROL_FREE: mark("Control is free."),
    Code.CONTROL_LAPSED: mark("{name} was not heard for {seconds} and lost control."),
    Code.CONTROL_ASKED: mark("{name} asks {driver} for control."),
    Code.CONTROL_OBJECTED: mark("{name} keeps control; {asker} asked for it."),
    Code.CONTROL_HELD: mark("{name} has control."),
    Code.CONTROL_HELD_ELSEWHERE: mark("This handheld has control elsewhere."),
    Code.CONTROL_ASKED_ALREADY: mark("{name} has asked {driver} for control already."),
    Code.CONTROL_OBJECTED_LATELY: mark("{name} keeps control: ask again in {seconds}."),
    Code.CONTROL_MANAGER_ASKS: mark("{name} manages this robot and takes control."),
    Code.CONTROL_NOT_ASKED: mark("No one asks for control."),
    Code.MODE_MANUAL: mark("{name} chose MANUAL: nothing starts by itself."),
    Code.SETTING_CHANGED: mark("{name} changed {setting} to {value}."),
    Code.NOBODY_DRIVES: mark("No one drives the robot: it goes into its safe state."),
    Code.DRIVE_LATE: mark("A drive command came too late and was dropped."),
    Code.DRIVE_CLOCK_AHEAD: mark("The clock of this handheld is {seconds} ahead of the robot's."),
    Code.DRIVE_NOT_RELEASED: mark("Stopped while the stick was held. Release it, then push it again."),
    Code.DRIVE_ON_GROUND: mark("No stick starts the rotors: take off first."),
    Code.DRIVE_TOUCHES: mark("The robot touches something there and is not pushed on."),
    Code.DRIVE_EXCESSIVE: mark("{robot} goes at {allowed}, not at {asked}."),
    Code.DRIVE_LEVEL: mark("The robot goes no higher or deeper than {height}."),
    Code.DRIVE_STEEP: mark("It is too steep there for the robot; drive back."),
    Code.MAP_ARRIVED: mark("There is a map now."),
    Code.MAP_MISSING: mark("There is no map: the robot can be driven by hand only."),
    Code.MAP_UNUSABLE: mark("The map cannot be used."),
    Code.POSITION_PLACED: mark("{name} placed the robot on the map."),
    Code.POSITION_UNKNOWN: mark("The robot does not know where it is. Place it on the map."),
    Code.POSITION_LOST: mark("No fix or compass: the robot assumes the map's origin. Place it on the map."),
    Code.POSITION_UNSURE: mark(
        "Position unsure: other places fit as well, or what the robot senses does not match the map. Place it on the map."
    ),
    Code.POSITION_UNSEEN: mark(
        "Position unsure: the laser meets too little to tell it. Drive to where it meets more, or place the robot on the map."
    ),
    Code.POSITION_SURE: mark("Position sure again."),
    Code.POSITION_BY_WHEELS: mark(
        "No laser: the position may drift. Place the robot on the map when it is off."
    ),
    Code.FENCE_LEFT: mark("The robot is outside its fence."),
    Code.FENCE_HEIGHT_UNKNOWN: mark(
        "Height unknown: the robot goes neither up nor down because of its fence."
    ),
    Code.FENCE_NEAR: mark("The fence is {room} away: the robot goes no nearer."),
    Code.FENCE_DRIFT: mark("{robot} drifts over its fence, or goes back from it."),
    Code.FENCE_UNPLACED: mark("Position unknown: the robot cannot keep to its fence. Place it on the map."),
    Code.FENCE_UNSURE: mark("Position unsure: the robot goes slowly, to keep to its fence."),
    Code.PLACE_OFF_MAP: mark("{place} is off the map."),
    Code.PLACE_IN_OBSTACLE: mark("{place} is in an obstacle."),
    Code.PLACE_NEAR_OBSTACLE: mark("{place} is too near to an obstacle."),
    Code.PLACE_OUTSIDE_FENCE: mark("{place} is outside the robot's fence."),
    Code.PLACE_NEAR_FENCE: mark("{place} is too near to the fence."),
    Code.TASK_STARTED: mark("{task} started."),
    Code.TASK_GOES_ON: mark("{task} goes on after the restart."),
    Code.TASK_RESUMED: mark("{task} resumed."),
    Code.TASK_DONE: mark("{task} is done."),
    Code.TASK_FAILED: mark("{task} failed."),
    Code.TASK_PLACE_UNSURE: mark("There, unsure of its place. Place the robot on the map, then start again."),
    Code.TASK_PLACE_ASKED: mark("Unsure of its place: several fit. Choose the right one on the map."),
    Code.TASK_LOOP_LATE: mark("Waiting: the robot's computer is too slow to drive by itself."),
    Code.SIMULATION_SLOW: mark("Simulation at {factor} of real time, {seconds} behind."),
    Code.LOOP_LATE: mark("The robot's computer is {seconds} late."),
    Code.LOOP_ON_TIME: mark("The robot's computer keeps up again."),
    Code.TASK_REPLACED: mark("{task} ended: {instead} was requested instead."),
    Code.TASK_INTERRUPTED: mark("A restart cut {task} short."),
    Code.TASK_STOPPED: mark("Stopped by {name}."),
    Code.TASK_PAUSED: mark("Paused by {name}."),
    Code.TASK_STAYS: mark("{name} had it stay at {place}, charging. Resume lets it go on."),
    Code.TASK_TAKEN_OVER: mark("{name} took the stick."),
    Code.TASK_LINK_LOST: mark("Paused: the link to {name} was lost."),
    Code.TASK_OVERTURNED: mark("Paused: {robot} has turned over."),
    Code.TASK_SENSOR_SILENT: mark("Paused: a sensor is silent."),
    Code.TASK_HELD_FAST: mark("Paused: the wheels turn, but something holds the robot."),
    Code.TASK_BUMPED: mark("Paused: the bumper touched something."),
    Code.TASK_INTRUDER: mark("Paused: intruder {id} was found."),
    Code.TASK_ROBOT_LOST: mark("Paused: the robot cannot be reached."),
    Code.TASK_CANCELED: mark("Canceled by {name}."),
    Code.TASK_DISCARDED: mark("Discarded by {name}."),
    Code.TASK_ASKER_GONE: mark("{name}, who started it, is gone."),
    Code.TASK_RESET: mark("{name} put the robot back."),
    Code.TASK_ROBOT_ENDS: mark("The robot's program ends."),
    Code.TASK_FAULT: mark("A fault of the robot's program ended it: {fault}."),
    Code.TASK_BATTERY: mark("The battery is at {charge}, and home cannot be reached."),
    Code.TASK_SLOW: mark("It took longer than {seconds}; the robot stays where it is."),
    Code.TASK_EDITED: mark("The patrol goes on with a new mission of {count} points."),
    Code.WAY_BLOCKED: mark("The way to {place} is blocked."),
    Code.WAY_MISSING: mark("There is no way to the place."),
    Code.WAY_ENDED: mark("The way straight on ended."),
    Code.HEIGHT_UNREACHED: mark("It reached {reached} and not {height}."),
    Code.DOCK_DEAD: mark("The dock {place} gives no charge."),
    Code.DOCK_UNSEEN: mark("The dock {place} is not seen where it should be."),
    Code.DOCK_TAGS_UNREAD: mark(
        "{place} is found by its tag, and the robot lacks pupil-apriltags to read it."
    ),
    Code.DOCK_TAKEN: mark("Something stands in the dock {place}."),
    Code.DOCK_BLOCKED: mark("Something stands before the dock {place}."),
    Code.UNDOCK_BLOCKED: mark("The dock {place} cannot be left."),
    Code.CHARGING: mark("Charging at {place}, {charge}; goes on at {until}."),
    Code.CHARGE_UNKNOWN: mark("{place}: the battery has been silent for {seconds}."),
    Code.CHARGE_LOST: mark("{place} charges no more, at {charge}."),
    Code.CHARGE_NEEDED: mark("{charge} is too little to go on with: {needed} is needed."),
    Code.CHARGE_CUT: mark("{name} had it go on at {charge}."),
    Code.CHARGE_INVALID: mark("The charge to stay for must be from {least} to 100 %."),
    Code.DOCK_MISSED: mark("The contacts at {place} did not meet."),
    Code.WAYPOINT_REACHED: mark("{place} reached."),
    Code.WAYPOINT_SKIPPED: mark("{place} cannot be reached and is skipped."),
    Code.MESSAGE_TOLD: mark("Told at {place}: {message}"),
    Code.FOLLOWER_LOST: mark("Nobody follows; the robot waits."),
    Code.FOLLOWER_BACK: mark("Somebody follows again."),
    Code.FOLLOWER_UNKNOWN: mark("Nothing tells whether somebody follows."),
    Code.ANSWER_GIVEN: mark("{name} confirmed at {place}."),
    Code.ANSWER_BY_CARD: mark("A tag confirmed at {place}."),
    Code.CARD_UNKNOWN: mark("No tag can answer at {place}."),
    Code.CARD_WRONG: mark("This tag is not the one for {place}."),
    Code.INTRUDER_FOUND: mark("Intruder {id} found: {kind}."),
    Code.INTRUDER_CIRCLED: mark("Intruder {id} was seen from {sides} of {count} sides; not seen: {missing}."),
    Code.BATTERY_LOW: mark("Battery low: {charge}."),
    Code.BATTERY_GOING_TO_DOCK: mark("Battery low: {charge}. Going to {place} to charge."),
    Code.BATTERY_GOING_HOME: mark("Battery low: {charge}. Going home."),
    Code.BUMPER_TOUCHED: mark("The bumper touched something."),
    Code.QUEUE_HELD: mark("{count} tasks wait until somebody resumes the queue."),
    Code.QUEUE_ADDED: mark("{task} waits in the queue."),
    Code.QUEUE_LEFT_OUT: mark("{task} of the queue cannot be done and is left out."),
    Code.SCHEDULE_SKIPPED: mark("{task} now is skipped."),
    Code.SCHEDULE_TIME_MISSING: mark("A scheduled task needs a time of day or a period, and not both."),
    Code.SCHEDULE_DAY_MISSING: mark("A scheduled task needs at least one day of the week."),
    Code.QUEUE_CHANGED: mark("The queue has changed meanwhile."),
    Code.MISSION_STORED: mark("{count} points stored on the robot."),
    Code.MISSION_EMPTY: mark("The mission has no points; set at least one."),
    Code.MISSION_UNKNOWN: mark("There is no mission {mission}."),
    Code.MISSION_TOO_LONG: mark("The mission has {count} points; {max} fit."),
    Code.DWELL_INVALID: mark("A stay at a point is from 0 to {max}, not {dwell}."),
    Code.LAPS_INVALID: mark("Laps are from 0 to {max}, not {laps}."),
    Code.TASK_UNKNOWN: mark("There is no task {task}."),
    Code.TASK_UNABLE: mark("{robot} does not know this task."),
    Code.TASK_ACTIVE: mark("Another task has not ended."),
    Code.TASK_NONE_RUNNING: mark("No task is running."),
    Code.TASK_NONE_PAUSED: mark("No task is paused."),
    Code.TASK_NONE_LEFT: mark("There is no task to go on with."),
    Code.TASK_ASKS_NOTHING: mark("The robot asks nothing just now."),
    Code.BATTERY_TOO_LOW: mark("The battery is at {charge}; this task needs {needed}."),
    Code.SENSORS_SILENT: mark("It can be driven by hand only: sensors are silent."),
    Code.ROBOT_OVERTURNED: mark("{robot} has turned over."),
    Code.HOME_UNSET: mark("Home is not set; set it on the map first."),
    Code.SPEED_INVALID: mark("A speed is above 0 and up to {max}, not {speed}."),
    Code.HEIGHT_UNUSED: mark("{robot} keeps no height; leave it out."),
    Code.HEIGHT_INVALID: mark("A height is from {lowest} to {highest}, not {height}."),
    Code.DURATION_INVALID: mark("A duration is up to {max}, not {duration}."),
    Code.DOCK_MISSING: mark("There is no dock."),
    Code.DOCK_UNDIRECTED: mark("The dock {place} has no direction."),
    Code.PLACES_TOO_MANY: mark("The task names {count} places; {max} fit."),
    Code.PLACE_UNKNOWN: mark("There is no place {place}."),
    Code.PLACE_UNNAMED: mark("A place needs a name."),
    Code.PLACE_NAME_TAKEN: mark("There is a {place} already."),
    Code.PLACES_LEFT_OUT: mark("Not all places of the world could be taken over."),
    Code.RECORDS_FULL: mark("No more than {max} of them can be stored."),
    Code.RECORDS_DAMAGED: mark("Something is wrong with what the robot kept."),
    Code.RECORDS_UNWRITTEN: mark("The robot's database cannot be written, or does not answer."),
    Code.RECORDS_WRITTEN: mark("The robot's database can be written again."),
    Code.COMMAND_LATE: mark("The command came too late: {age} old, where {allowed} are allowed."),
    Code.COMMAND_AHEAD: mark("The clock of this handheld is {seconds} ahead of the robot's."),
    Code.ROBOT_UNREACHABLE: mark("The robot cannot be reached, or not be driven."),
    Code.ROBOT_BACK: mark("The robot can be driven again; it stands still."),
    Code.ROBOT_RESET: mark("{name} put {robot} back to where it started."),
    Code.ROBOT_FAULT: mark("The robot's program has a fault: {fault}"),
    Code.ROBOT_SUNK: mark("{robot} has sunk."),
    Code.ROBOT_ASTRAY: mark("{robot} has left its world."),
    Code.ROBOT_BESIDE_START: mark("There is no room at its start: {robot} stands {aside} beside it."),
    Code.ORDER_CUT: mark("An order was cut to what {robot} can do."),
    Code.ARM_REPLACED: mark("{name} gave the arm another order."),
    Code.ARM_HELD: mark("The arm was held before it was there."),
    Code.ARM_LATE: mark("The arm was not there within {allowed}."),
}
"""Codes to what they say; of those that are not here only programmers and managers of the robot's computer read."""


def sentence(code: str, parameters: Iterable[KeyValue], own_words: str) -> str:
    """What a robot says by `code`, in the language of the glass and the operator's units; `own_words` are its English ones.

    Its own words stand where the glass speaks English and the units in which a robot speaks.
    """
    values = {pair.key: pair.value for pair in parameters}
    words = SENTENCES.get(code, "")
    if language.name == "en" and (quantities.system == "metric" or not _has_units(code, words, values)):
        return own_words
    try:
        shown = {key: _shown(code, key, values) for key in values}
        return tr(words).format_map(shown) if words else own_words
    except (KeyError, IndexError, ValueError):  # a robot that leaves out what its code should name
        return own_words


def _has_units(code: str, words: str, values: Mapping[str, str]) -> bool:
    """Something stands in these `words` that is not the same in every system of units."""
    kinds = {quantity_of(code, key, values) for key in values if f"{{{key}}}" in words}
    return not kinds.isdisjoint(("length", "height", "speed"))


def _shown(code: str, key: str, values: Mapping[str, str]) -> str:
    """A parameter as people read it: a quantity in their units, a word that is known in their language."""
    value, kind = values[key], quantity_of(code, key, values)
    if key in _WORDS:
        return _WORDS[key](value)
    if not kind:
        return tr(ROLES[value]) if key in ("role", "needed") and value in ROLES else value
    try:
        return quantity_words(float(value), kind)
    except ValueError:
        return value


def _task(name: str) -> str:
    return TASKS[name].name if name in TASKS else name


_SIDES: Mapping[str, str] = {
    "east": mark("east"),
    "north-east": mark("north-east"),
    "north-west": mark("north-west"),
    "west": mark("west"),
    "south-west": mark("south-west"),
    "south-east": mark("south-east"),
}


def _sides(names: str) -> str:
    """Sides of something, as the robot names them, each in the language of the glass."""
    if not names:
        return tr("no side")
    return ", ".join(tr(_SIDES.get(name, name)) for name in names.split(", "))


_WORDS: Mapping[str, Callable[[str], str]] = {
    "task": _task,
    "instead": _task,
    "payload": payload_title,
    "state": lambda word: tr({"on": mark("on"), "off": mark("off")}.get(word, word)),
    "kind": kind_word,
    "missing": _sides,
}
"""Key of a parameter that is a word of the robot's, to that word in the language of the glass."""
