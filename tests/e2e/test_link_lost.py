"""The link dies at the worst moment: the robot stops by itself, nothing old arrives, nothing entered is lost."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.client.client import Phase
from examples.demo.fingers import Finger
from examples.demo.witness import Witness
from tests.e2e.handheld import Cable, Handheld, handheld

AT_REST = 0.02
"""A robot slower than this stands [m/s]."""
SOON = 0.5
"""A lost link has the robot at rest within this [s], its watchdog's 0.3 s included."""
STEADY, FAST = 0.3, 0.4
"""A robot that was on average this fast [m/s] for so long [s] does what the stick says: it neither starts nor brakes."""
SAMPLING = 0.15
"""What the truth lags behind, at 20 Hz and over three of its poses [s]."""


def drive_off(glass: Handheld, witness: Witness) -> Finger:
    """Push the stick and leave the finger there until the robot is at the speed that it asks for."""
    stick = glass.one("Joystick")
    glass.control()
    glass.until(lambda: stick.state == "live", "a live stick")
    return glass.drive(stick, lambda: stick.finger is not None and witness.fast(STEADY) > FAST)


def seconds_until_rest(glass: Handheld, witness: Witness) -> float:
    """From now until the robot stands [s, robot clock: it does not go on while the machine stands still]."""
    since = witness.now
    glass.until(
        lambda: witness.speed() < AT_REST and witness.rested(since, AT_REST) >= 0, "the robot to stand"
    )
    return witness.rested(since, AT_REST)


@pytest.mark.parametrize("how", ["freeze", "cut"])
def test_a_pushed_stick_and_a_lost_link_bring_the_robot_to_rest_and_nothing_old_moves_it_later(
    how: str, cable: Cable, witness: Witness, tmp_path: Path
) -> None:
    with handheld(tmp_path, url=cable.url, screen="drive", discover=False) as glass:
        finger = drive_off(glass, witness)
        getattr(cable, how)()
        assert seconds_until_rest(glass, witness) < SOON + SAMPLING
        rested_at = witness.truth
        glass.run(0.5)
        cable.thaw()
        glass.until(lambda: glass.app.session.link_state.phase is Phase.CONNECTED, "the link to heal")
        glass.run(1.5)
        assert witness.distance(*rested_at[1:3]) < 0.05, "a finger that never left the glass must push anew"
        glass.hand.up(finger)
        drive_off(glass, witness)


def test_a_link_that_dies_in_silence_is_said_on_the_glass_and_heals_by_itself(
    cable: Cable, witness: Witness, tmp_path: Path
) -> None:
    with handheld(tmp_path, url=cable.url, discover=False) as glass:
        glass.control()
        granted = glass.asked
        cable.freeze()
        glass.until(lambda: not glass.app.session.connected, "the app to notice", 6.0)
        glass.until(
            lambda: any("try" in words.lower() or "lost" in words.lower() for words in glass.words()),
            "a sentence",
        )
        cable.thaw()
        glass.until(lambda: glass.app.session.connected, "the link to heal", 8.0)
        glass.control(since=granted)
