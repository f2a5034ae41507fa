"""A robot that had a mishap is put back from the app, after a second press."""

from __future__ import annotations

from bridge.msgs.pilothouse_msgs import Event
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass


def test_a_mishap_offers_to_put_the_robot_back_and_the_second_press_does(
    driving: Glass, robot: FakeRobot
) -> None:
    glass, card = driving, driving.app.shell.reset.card
    said = "Patrol-1 has turned over."
    robot.publish("/events", Event(id=1, boot="b", level="alarm", kind="robot", text=said))
    glass.until(lambda: card.parent is not None, "no card")
    assert card.headline == said
    assert said not in glass.banners()
    glass.stage.run_for(0.6)
    glass.tap(card.go)
    glass.stage.run_for(0.6)
    assert not any(name == "/robot/reset" for name, _ in robot.asked)
    glass.tap(card.go)
    glass.until(lambda: any(name == "/robot/reset" for name, _ in robot.asked), "not asked")
    glass.until(lambda: card.parent is None, "the card stays")

    # the settings ask first as well
    glass.app.show("tasks")
    tasks = glass.app.screens["tasks"]
    tasks.open("settings")
    glass.until(lambda: not tasks.settings_pane.back.disabled, "no button")
    glass.tap(tasks.settings_pane.back)
    glass.until(lambda: card.parent is not None, "not asked about")
    assert card.asked
