"""The inputs screen with fingers, and what waits over every screen of a robot."""

from __future__ import annotations

from app.intents.intents import CANCEL_TIME, Heard
from app.screens.inputs.pane_table import PANES, panes
from app.screens.inputs.screen import InputsScreen
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass


class Fake:
    """A way in that notes what becomes of it."""

    name, problem = "voice", ""

    def __init__(self) -> None:
        self.on, self.begun, self.closed = False, 0, False

    @property
    def standing(self) -> str:
        return "listening" if self.on else "off"

    def start(self) -> None:
        self.begun += 1

    def stop(self) -> None:
        self.begun = 0

    def close(self) -> None:
        self.closed = True


def test_every_pane_that_there_is_opens_and_leaves_without_a_robot(glass: Glass) -> None:
    glass.tap(glass.app.connect.ids.inputs)
    page = glass.app.pages.lone("inputs")
    glass.until(lambda: page.parent is not None, "the inputs are not on the glass")
    assert isinstance(page.screen, InputsScreen)
    assert set(panes()) <= set(PANES)
    for name in panes():
        page.screen.open(name)
        glass.stage.frames(3)
        assert page.screen.pane(name).parent is not None, name
        page.tick()
    assert glass.app.back(), "there is no way back"
    while page.parent is not None:
        assert glass.app.back()
    assert glass.app.connect.parent is not None


def test_a_method_is_switched_on_by_a_finger_and_its_icon_stands_on_the_bar(
    glass: Glass, robot: FakeRobot
) -> None:
    app, fake = glass.app, Fake()
    app.methods._all["tilt"] = fake
    app.open(robot.url)
    glass.until(lambda: app.shell is not None, "no screens")
    glass.tap(app.shell.ids.inputs)
    glass.until(lambda: app.shell.screen == "inputs", "the chip leads nowhere")
    row = app.screens["inputs"].rows["tilt"]
    glass.stage.frames(3)
    glass.tap(row.switch)
    glass.until(lambda: fake.on and fake.begun, "it is off")
    glass.until(lambda: ("tilt", True) in app.shell.bar.ids.inputs.methods, "the bar does not show it")
    fake.problem = "The sensor is silent."
    glass.until(lambda: row.detail == "The sensor is silent.", "its problem is not said")
    app.on_pause()
    assert not fake.begun, "it listens while the glass is away"
    app.on_resume()
    assert fake.begun


def test_what_was_understood_asks_over_the_screen_and_a_finger_says_yes(
    glass: Glass, robot: FakeRobot
) -> None:
    app = glass.app
    app.open(robot.url)
    glass.until(lambda: app.shell is not None and app.session.control == "mine", "no control")
    assert app.intents.submit(Heard("go_home", "voice", confidence=0.8, said="go home")).what == "asks"
    card = app.shell.wishes.card
    glass.until(lambda: card.parent is not None, "nothing asks")
    assert "Voice, “go home”: 80 % sure." in card.said
    yes = next(button for button in card.walk(restrict=True) if getattr(button, "text", "") == "Yes")
    stop = app.shell.stop
    assert card.y >= stop.top or card.right <= stop.x, "it covers STOP"
    glass.tap(yes)
    assert robot.until(lambda: any(name == "/task/go_home" for name, _ in robot.asked))
    glass.until(lambda: "home" in app.session.outcomes, "nothing came of it")
    assert app.session.outcomes["home"].origin.method == "voice"
    glass.until(lambda: card.parent is None, "it still asks")


def test_what_waits_is_cancelled_by_a_finger_and_a_refusal_is_said(glass: Glass, robot: FakeRobot) -> None:
    app = glass.app
    app.open(robot.url)
    glass.until(lambda: app.shell is not None and app.session.control == "mine", "no control")
    app.intents.submit(Heard("start", "shake"))
    glass.until(lambda: any("Shake may not" in text for text in glass.banners()), "it is not said")
    app.session.authority.release()
    glass.until(lambda: app.session.control == "free", "control is not given up")
    app.intents.submit(Heard("take_control", "voice"))
    card = app.shell.wishes.card
    glass.until(lambda: card.parent is not None, "nothing waits")
    cancel = next(button for button in card.walk(restrict=True) if getattr(button, "text", "") == "Cancel")
    glass.tap(cancel)
    glass.stage.run_for(CANCEL_TIME + 0.2)
    assert app.session.control == "free"
