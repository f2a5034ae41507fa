"""The log in the whole app, in front of a robot: a finger and a voice leave one line each, with the robot's answer."""

from __future__ import annotations

from app.intents.intents import Heard
from app.study.response_log import read


def test_a_finger_and_a_voice_leave_a_line_each_with_what_the_robot_answered(driving):
    app = driving.app
    driving.tap(app.shell.stop)
    driving.until(lambda: app.session.robot_stop.latched, "the robot was not stopped")
    app.intents.submit(Heard("lights", "voice", 0.9, app.now() - 0.5, app.now() - 0.1, said="lights"))
    driving.stage.frames(5)
    log = app.methods.get("log")
    log.tracks.close()
    log.archive.log.flush()
    lines = [one for one in read(log.archive.folder)[0] if one.kind == "command"]
    stop = next(one for one in lines if one.recognised == "stop")
    assert (stop.method, stop.outcome, stop.verdict) == ("button", "accepted", "acted")
    assert stop.t_input_start <= stop.t_sent <= stop.t_ack
    assert stop.t_effect is not None
    voice = next(one for one in lines if one.method == "voice")
    assert (voice.recognised, voice.said, voice.confidence) == ("lights", "lights", 0.9)
