"""What is understood as a shake, along which line, when it is said, and what never is one."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable

import numpy as np
import pytest

from app.inputs.motion.shake import AXES, Axis, Recogniser, Shake
from bench.support import motion, people
from bench.support.motion import Recording, Trial
from tests.lacking import lacking

GRAVITY = 9.80665


def heard(
    samples: Iterable[tuple[float, float, float]], rate: float = 60.0, *, any_shake: bool = False
) -> list[Shake]:
    """Everything that is understood in samples that come at `rate`."""
    recogniser = Recogniser(any_shake=any_shake)
    found = (recogniser.feed(index / rate, axes) for index, axes in enumerate(samples))
    return [shake for shake in found if shake is not None]


def of(take: Recording, *, any_shake: bool = False) -> list[Shake]:
    return heard(map(tuple, take.samples.tolist()), take.rate, any_shake=any_shake)


def shaken(axis: str, person: int = 0, walks: list[Recording] | None = None) -> list[Trial]:
    return motion.trials([motion.made(axis, person, seed) for seed in range(2)], 3, walks)


@pytest.mark.parametrize("person", range(len(motion.PEOPLE)))
@pytest.mark.parametrize("axis", AXES)
def test_a_shake_is_understood_along_its_line_whoever_shakes(axis: Axis, person: int) -> None:
    said = Counter(tuple(shake.axis for shake in of(trial.take)) for trial in shaken(axis, person))
    assert said[(axis,)] >= 5
    assert set(said) <= {(axis,), ()}, "what is not understood is nothing, and no other command"


@pytest.mark.parametrize("axis", AXES)
def test_it_is_understood_while_walking(axis: Axis) -> None:
    walks = [motion.walking(60.0, 1)]
    said = [
        [shake.axis for shake in of(trial.take)] for person in (0, 1) for trial in shaken(axis, person, walks)
    ]
    assert said.count([axis]) >= 10


def test_stop_is_said_inside_the_shake_and_the_others_after_it() -> None:
    for axis in AXES:
        for trial in shaken(axis):
            (shake,) = of(trial.take)
            assert (shake.told < trial.ended) == (axis == "lr")
            assert shake.ended == (axis != "lr")
            assert shake.began == pytest.approx(trial.began, abs=0.4)
            assert 0.0 < shake.confidence <= 1.0


@pytest.mark.parametrize("rate", [25.0, 50.0, 100.0, 200.0])
def test_the_rate_of_the_sensor_matters_not_from_25_hz_on(rate: float) -> None:
    for axis in AXES:
        for trial in shaken(axis):
            assert [shake.axis for shake in of(trial.take.again(rate))] == [axis]


def test_a_phone_that_measures_gravity_downward_is_understood_alike() -> None:
    for axis in AXES:
        for trial in shaken(axis):
            upside = heard(map(tuple, (-trial.take.samples).tolist()), trial.take.rate)
            assert [shake.axis for shake in upside] == [axis]


def test_however_it_is_held_up_is_up() -> None:
    for lean in np.linspace(0.0, 1.5, 5):
        take = shaken("ud")[0].take
        turn = np.array(
            [[1, 0, 0], [0, math.cos(lean), -math.sin(lean)], [0, math.sin(lean), math.cos(lean)]]
        )
        assert [shake.axis for shake in heard(map(tuple, (take.samples @ turn.T).tolist()))] == ["ud"]


@pytest.mark.parametrize("upright", [0.8, 1.0, 1.3])
def test_held_sideways_with_a_screen_that_stays_left_right_is_stop(upright: float) -> None:
    """A screen that is locked: what is its own y goes to the right."""
    still = np.tile([GRAVITY * math.sin(upright), 0.0, GRAVITY * math.cos(upright)], (240, 1))
    at = np.arange(120) / 60.0
    shake = still[:120] + np.outer(8.0 * np.sin(math.tau * 1.5 * at), [0.0, 1.0, 0.0])
    samples = np.concatenate([still, shake, still])
    assert [shake.axis for shake in heard(map(tuple, samples.tolist()))] == ["lr"]


@pytest.mark.parametrize("turn", ["yaw", "roll", "pitch"])
@pytest.mark.parametrize("by", [-25.0, 25.0])
def test_a_line_aslant_is_taken_for_the_direction_it_is_nearest_to(turn: str, by: float) -> None:
    rng = np.random.default_rng(4)
    body = people.Body(**{turn: math.radians(by)})
    for axis in AXES:
        trials = [people.trial(body, motion.made(axis, 0, seed), 0.3, rng) for seed in range(3)]
        assert [[shake.axis for shake in of(trial.take)] for trial in trials].count([axis]) >= 2


def moved(*parts: tuple[tuple[float, float, float], float]) -> list[tuple[Axis, bool]]:
    """What is understood, and whether the movement was over by then, of a phone held upright that is shaken along lines (right, up,
    forward), each for so long [s]."""
    still = np.tile([0.0, GRAVITY, 0.0], (300, 1))
    swings = []
    for line, seconds in parts:
        at = np.arange(int(seconds * 60)) / 60.0
        way = np.array(line) / np.linalg.norm(line)
        swings.append(still[: len(at)] + np.outer(8.0 * np.sin(math.tau * 1.7 * at), way))
    samples = np.concatenate([still, *swings, still])
    return [(shake.axis, shake.ended) for shake in heard(map(tuple, samples.tolist()))]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ((1.0, 0.0, 0.6), [("lr", False)]),
        ((1.0, 0.0, 1.0), []),
        ((0.8, 0.0, 1.0), [("fb", True)]),
        ((1.0, 0.6, 0.0), [("lr", False)]),
        ((1.0, 0.7, 0.0), [("lr", False)]),
        ((1.0, 0.9, 0.0), []),
        ((0.6, 1.0, 0.0), [("ud", True)]),
    ],
)
def test_stop_is_told_inside_the_shake_only_where_it_is_clearly_left_right(
    line: tuple[float, float, float], said: list[tuple[Axis, bool]]
) -> None:
    """Right half-way between two directions it waits for the end, and may be neither."""
    assert moved((line, 2.0)) == said


@pytest.mark.parametrize(("turned", "cycles", "said"), [(0, 1.75, ["lr"]), (80, 1.75, []), (80, 3.2, ["lr"])])
def test_a_phone_that_was_just_turned_takes_more_to_stop(
    turned: float, cycles: float, said: list[str]
) -> None:
    """Out of a pocket: three half cycles are how a hand fumbles."""
    count = int(60 * cycles / 1.7)
    at = np.arange(count) / 60.0
    shake = np.outer(7.0 * np.sin(math.tau * 1.7 * at), [1.0, 0.0, 0.0])
    lean = np.concatenate([np.full(300, math.radians(turned)), np.linspace(math.radians(turned), 0.0, 30)])
    poses = np.stack([0 * lean, GRAVITY * np.cos(lean), GRAVITY * np.sin(lean)], 1)
    upright = np.tile([0.0, GRAVITY, 0.0], (180, 1))
    samples = np.concatenate([poses, upright, upright[:1] + shake, upright])
    assert [shake.axis for shake in heard(map(tuple, samples.tolist()))] == said


def test_left_right_that_begins_late_in_a_long_movement_is_no_stop() -> None:
    """A phone that has been swung about for long is not being asked to stop."""
    aside, ahead = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    assert moved((ahead, 0.4), (aside, 1.5)) == [("lr", False)]
    assert moved((ahead, 3.0), (aside, 1.5)) == []


def test_a_swing_about_the_elbow_a_weak_beginning_and_a_slow_hand_are_stop() -> None:
    rng = np.random.default_rng(4)
    for body in (people.Body(arm=0.35), people.Body(first=0.4, ramp=0.3), people.Body(strong=0.7, quick=0.9)):
        for seed in range(3):
            trial = people.trial(body, motion.made("lr", 0, seed), 0.3, rng)
            assert [shake.axis for shake in of(trial.take)] == ["lr"], body


def test_samples_that_come_unevenly_and_get_lost_are_enough() -> None:
    rng = np.random.default_rng(4)
    sensor = people.Sensor(rate=30.0, jitter=0.3, lost=0.05, downward=True)
    for axis in AXES:
        for trial in shaken(axis):
            recogniser = Recogniser()
            said = [recogniser.feed(t, axes) for t, axes in people.measured(sensor, trial.take, rng)]
            assert [shake.axis for shake in said if shake] == [axis]


@pytest.mark.parametrize("person", [0, 3, 4])
@pytest.mark.parametrize("axis", AXES)
def test_a_cheap_sensor_is_enough(axis: Axis, person: int) -> None:
    """One that ends at 2 g, counts in 12 bits, is 0.5 m/s² off and 3 % wrong."""
    for trial in shaken(axis, person)[:2]:
        step = 4.0 * GRAVITY / 4096.0
        felt = trial.take.samples * [1.03, 0.97, 1.02] + [0.5, -0.4, 0.5]
        felt = np.round(np.clip(felt, -2.0 * GRAVITY, 2.0 * GRAVITY) / step) * step
        assert [shake.axis for shake in heard(map(tuple, felt.tolist()))] == [axis]


# what is no shake


def test_nobody_who_walks_starts_to_walk_or_drives_gives_a_command() -> None:
    walks = [motion.walking(60.0, seed) for seed in range(3)]
    for take in [*walks, *motion.starts(walks), *motion.car(1 / 30)]:
        assert of(take) == [], take.label


def test_a_drawn_circle_is_no_shake() -> None:
    assert [of(motion.drawn(12.0, seed)) for seed in range(6)] == [[]] * 6


def test_what_is_drawn_round_is_no_shake_of_any_size_tempo_plane_and_width() -> None:
    assert sum(bool(of(motion.ellipse(seed))) for seed in range(150)) <= 1


def ellipse(wide: float, often: float, shivers: float = 0.0) -> list[str]:
    """What is understood of one that is drawn on the table, so many times as wide as long and so often a second, in a car that shivers
    up and down [m/s²]."""
    at = np.arange(144) / 60.0
    swing = np.stack(
        [6.0 * np.cos(math.tau * often * at), 0.0 * at, 6.0 * wide * np.sin(math.tau * often * at)]
    )
    samples = np.concatenate([np.zeros((300, 3)), swing.T, np.zeros((150, 3))])
    samples[:, 1] += GRAVITY + shivers * np.sin(math.tau * 13.0 * np.arange(len(samples)) / 60.0)
    return [shake.axis for shake in heard(map(tuple, samples.tolist()))]


def test_what_is_slow_has_to_be_the_straighter_to_be_a_shake() -> None:
    assert ellipse(0.1, 0.8) == ["lr"]
    assert ellipse(0.3, 1.0) == []
    assert ellipse(0.3, 2.0) == ["lr"]


def test_what_shivers_beside_it_makes_a_slow_ellipse_no_quicker() -> None:
    assert ellipse(0.1, 0.8, shivers=3.0) == ["lr"]
    assert ellipse(0.25, 0.8, shivers=3.0) == []


def test_a_line_that_is_bent_to_an_arc_is_not_round() -> None:
    """A hand swings about the elbow and back: there it turns one way, back the other."""
    rng = np.random.default_rng(2)
    trials = [people.trial(people.Body(arm=0.3), motion.made("lr", 0, seed), 0.3, rng) for seed in range(6)]
    assert [[shake.axis for shake in of(trial.take)] for trial in trials].count(["lr"]) == 6


def test_rhythmic_exercises_of_the_arm_are_none() -> None:
    takes = motion.packaged()
    if not takes:
        lacking("seglearn")
    people = {take.person for take in takes}
    chosen = [take for take in takes if take.person in sorted(people)[:3]]
    assert sum(len(of(take)) for take in chosen) == 0


def test_a_circle_on_the_wall_is_no_shake_however_short() -> None:
    for cycles in (2, 3):
        phase = math.tau * np.arange(int(cycles * 50)) / 50.0
        swing = [(7.0 * math.cos(at), GRAVITY + 7.0 * math.sin(at), 0.0) for at in phase]
        still = [(0.0, GRAVITY, 0.0)] * 240
        assert heard([*still, *swing, *still]) == []


@pytest.mark.parametrize("axis", ["ud", "fb"])
def test_what_goes_on_for_longer_than_a_shake_is_no_command(axis: Axis) -> None:
    take = motion.made(axis, 0, 0)
    still = np.tile(take.samples.mean(axis=0), (300, 1))
    for seconds, said in ((2.5, [axis]), (4.2, []), (7.0, [])):
        samples = np.concatenate([still, take.samples[: int(seconds * 60)], still])
        assert [shake.axis for shake in heard(map(tuple, samples.tolist()))] == said


def test_a_knock_and_a_fall_are_nothing() -> None:
    still = [(0.0, 0.0, GRAVITY)] * 240
    knock = [(25.0, 0.0, GRAVITY)] * 3 + [(-20.0, 0.0, GRAVITY)] * 3
    fall = [(0.0, 0.0, 0.1)] * 30 + [(0.0, 0.0, 60.0)] * 3
    assert heard([*still, *knock, *still, *fall, *still]) == []


@pytest.mark.parametrize("high", [0.3, 0.45])
def test_what_falls_and_is_caught_is_no_command(high: float) -> None:
    """It swings in the hand that catches it, up and down."""
    at = np.arange(60) / 60.0
    caught = GRAVITY + 45.0 * np.exp(-at / 0.12) * np.sin(math.tau * 4.0 * at)
    for fall, said in ((high, []), (0.0, ["ud"])):
        up = [GRAVITY] * 240 + [0.0] * int(fall * 60) + caught.tolist() + [GRAVITY] * 120
        assert [shake.axis for shake in heard((0.0, 0.3, value) for value in up)] == said


def test_one_stroke_is_nothing_and_neither_is_one_there_and_back() -> None:
    for halves in (1, 2):
        at = np.arange(60) / 60.0
        stroke = np.where(at < halves * 0.3, 12.0 * np.sin(math.pi * at / 0.3), 0.0)
        samples = [(value, 0.0, GRAVITY) for value in (*([0.0] * 240), *stroke, *([0.0] * 120))]
        assert heard(samples) == [], f"{halves} half cycles"


# the option


def test_any_strong_shake_is_told_at_once_where_that_is_wanted() -> None:
    for trial in shaken("ud", 4):
        assert of(trial.take)[0].ended
        first = of(trial.take, any_shake=True)[0]
        assert not first.ended
        assert first.told < trial.ended


# bad input


def test_what_is_no_number_or_comes_twice_is_passed_over() -> None:
    trial = shaken("lr")[0]
    recogniser, said = Recogniser(), []
    for index, axes in enumerate(map(tuple, trial.take.samples.tolist())):
        for wrong in ((math.nan, 0.0, 0.0), (0.0, math.inf, 0.0)):
            assert recogniser.feed(index / 60.0 + 0.001, wrong) is None
        said += [recogniser.feed(index / 60.0, axes) for _ in range(2)]
    assert [shake.axis for shake in said if shake] == ["lr"]


def test_after_a_gap_it_begins_anew() -> None:
    trial = shaken("lr")[0]
    recogniser = Recogniser()
    samples = list(map(tuple, trial.take.samples.tolist()))
    cut = int(trial.began * 60) - 6
    for index, axes in enumerate(samples[:cut]):
        recogniser.feed(index / 60.0, axes)
    begun = cut / 60.0 + 1.0
    said = [
        recogniser.feed(begun + index / 60.0, axes) for index, axes in enumerate(samples[cut : cut + 120])
    ]
    assert not any(said), "nothing is known of the background"


def test_a_clock_that_was_set_back_begins_anew_instead_of_making_it_deaf() -> None:
    trial = shaken("lr")[0]
    recogniser = Recogniser()
    samples = list(map(tuple, trial.take.samples.tolist()))
    for index, axes in enumerate(samples[:120]):
        recogniser.feed(5000.0 + index / 60.0, axes)
    said = [recogniser.feed(index / 60.0, axes) for index, axes in enumerate(samples)]
    assert [shake.axis for shake in said if shake] == ["lr"]


@pytest.mark.parametrize("after", [25.0, 100.0])
def test_a_rate_that_changes_within_the_shake_matters_not(after: float) -> None:
    for axis in AXES:
        trial = shaken(axis)[0]
        middle = (trial.began + trial.ended) / 2
        recogniser, said = Recogniser(), []
        for rate, within in ((50.0, (0.0, middle)), (after, (middle, math.inf))):
            for index, axes in enumerate(map(tuple, trial.take.again(rate).samples.tolist())):
                if within[0] <= index / rate < within[1]:
                    said.append(recogniser.feed(index / rate, axes))
        assert [shake.axis for shake in said if shake] == [axis]
