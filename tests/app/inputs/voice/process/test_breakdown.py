"""When a recogniser hangs, what is said about one that broke down, and whether it is started again."""

import pytest

from app.inputs.voice.process.breakdown import (
    ASK_TIMEOUT,
    CHECK_PERIOD,
    HANG_TIMEOUT,
    LOAD_TIMEOUT,
    LOADING_HANG_TIMEOUT,
    MAX_REASON,
    RESTART_WINDOW,
    Breakdowns,
    LifeSigns,
    reason,
)

STALL = 10.0


def after(signs, seconds, began=0.0, step=CHECK_PERIOD):
    for beat in range(1, round(seconds / step) + 1):
        signs.beat(began + beat * step)
    return signs


def ready():
    signs = LifeSigns(0.0)
    signs.loading = False
    return signs


def test_one_that_gives_no_sign_hangs_and_says_for_how_long():
    signs = after(ready(), HANG_TIMEOUT)
    assert (signs.hangs, signs.why) == (True, "it gave no sign for 12 s")
    assert HANG_TIMEOUT < 15


def test_a_stall_of_ten_seconds_is_no_hang():
    assert not after(ready(), STALL).hangs
    assert not after(LifeSigns(0.0), 2 * STALL).hangs


def test_each_sign_begins_anew():
    signs = after(ready(), STALL)
    signs.heard(STALL)
    assert not after(signs, STALL, began=STALL).hangs


def test_a_machine_that_stood_still_blames_nobody():
    signs = ready()
    signs.beat(1000.0)
    assert not signs.hangs
    signs.beat(0.0)  # a clock that goes back is no sign and no silence
    assert signs.silent == 2 * CHECK_PERIOD


def test_one_that_never_answers_while_it_loads_hangs_as_well():
    assert not after(LifeSigns(0.0), HANG_TIMEOUT).hangs
    assert after(LifeSigns(0.0), LOADING_HANG_TIMEOUT).hangs


def test_a_load_may_take_minutes_while_it_answers_but_not_for_ever():
    signs = LifeSigns(0.0)
    for second in range(1, int(LOAD_TIMEOUT)):
        signs.heard(float(second))
    assert not signs.hangs
    signs.heard(LOAD_TIMEOUT)
    assert (signs.hangs, signs.why) == (True, "it was not ready after 180 s")


def test_the_load_is_over_when_it_is_ready():
    signs = LifeSigns(0.0)
    for second in range(1, 2 * int(LOAD_TIMEOUT)):
        signs.heard(float(second))
        signs.loading = False
    assert not signs.hangs


def test_it_is_asked_once_in_each_silence():
    signs = ready()
    asked = []
    for second in range(1, 8):
        signs.beat(float(second))
        asked.append(signs.asks())
    assert asked == [second == ASK_TIMEOUT for second in range(1, 8)]
    signs.heard(8.0)
    assert not signs.asks()
    assert after(signs, ASK_TIMEOUT, began=8.0).asks()


def test_the_second_within_the_window_is_the_last():
    breakdowns = Breakdowns()
    again, sentence = breakdowns.sentence("crashed", "out of memory.", 0.0)
    assert (again, sentence) == (True, "Voice recognition crashed and is started again: out of memory.")
    again, sentence = breakdowns.sentence("hung", "it gave no sign for 12 s", RESTART_WINDOW - 1.0)
    assert not again
    assert sentence == (
        "Voice recognition hung, the second time within 10 min, and is off: it gave no sign for 12 s. "
        "Switch it on again, or command by touch."
    )


def test_those_that_are_hours_apart_never_end_it():
    breakdowns = Breakdowns()
    assert all(breakdowns.sentence("crashed", "", hour * 3600.0)[0] for hour in range(5))


def test_where_no_reason_is_known_none_is_said():
    assert Breakdowns().sentence("crashed", "", 0.0)[1] == "Voice recognition crashed and is started again."


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("MemoryError: no room\n", "MemoryError: no room"),
        ("\x1b[31mred\x1b[0m\t and \x00more ", "[31mred [0m and more"),
        ("\n", ""),
        ("x" * 5000, "x" * (MAX_REASON - 1) + "…"),
    ],
)
def test_a_reason_is_one_short_line(line, said):
    assert reason(line) == said
