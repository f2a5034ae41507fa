"""Python's collector comes when the app calls it, for what there is, and goes back to Python afterwards."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator

import pytest

from app import garbage_collector as garbage
from app.garbage_collector import Collector
from tests.app.glass import Glass
from tests.thrown import Lasting, automatic, make_much, throw_away


class Cycle:
    """Nothing but the collector ends it."""

    def __init__(self) -> None:
        self.itself = self


def dropped() -> weakref.ref[Cycle]:
    return weakref.ref(Cycle())


@pytest.fixture
def collector(monkeypatch: pytest.MonkeyPatch) -> Iterator[Collector]:
    monkeypatch.setattr(Collector, "_at_work", 0)  # that of the tests is away for a while
    with automatic():
        collector = Collector()
        gc.collect()
        yield collector
        collector.close()


def test_without_it_a_widget_that_was_thrown_away_vanishes_in_the_middle_of_its_rule() -> None:
    lasting = Lasting()
    with automatic():
        throw_away(lasting)
        with pytest.raises(ReferenceError):
            lasting.name = "after"


def test_with_it_the_widget_stays_until_the_rule_is_through(collector: Collector) -> None:
    lasting = Lasting()
    gone = throw_away(lasting)
    lasting.name = "after"
    assert gone().followed[0] == "after"
    collector.expect(gone())
    collector.step()
    assert gone() is None


def test_nothing_is_collected_before_it_looks(collector: Collector) -> None:
    gone = dropped()
    make_much(None)
    assert gone() is not None


def test_what_few_objects_made_waits(collector: Collector) -> None:
    gone = dropped()
    collector.step()
    assert gone() is not None


def test_when_many_objects_were_made_the_young_are_collected(collector: Collector) -> None:
    gone = dropped()
    kept = [[] for _ in range(garbage.YOUNG)]
    collector.step()
    assert gone() is None
    assert kept


def old() -> tuple[Cycle, weakref.ref[Cycle]]:
    """One that outlived a look, and how to see that it is gone."""
    cycle = Cycle()
    gc.collect(0)
    return cycle, weakref.ref(cycle)


def test_the_old_are_left_until_much_has_grown_old_with_them(collector: Collector) -> None:
    cycle, gone = old()
    del cycle
    kept = [[] for _ in range(garbage.OLD // 2)]
    collector.step()
    assert gone() is not None
    kept += [[] for _ in range(garbage.OLD)]
    collector.step()
    collector.step()
    assert gone() is None


def test_while_much_is_being_made_the_old_are_left_until_it_is_there(collector: Collector) -> None:
    cycle, gone = old()
    del cycle
    kept = [[] for _ in range(garbage.OLD)]
    for _ in range(3):
        kept += [[] for _ in range(2 * garbage.GROWTH)]
        collector.step()
        assert gone() is not None
    collector.step()
    assert gone() is None


def test_what_is_made_without_end_does_not_put_it_off_for_good(collector: Collector) -> None:
    cycle, gone = old()
    del cycle
    kept = [[] for _ in range(garbage.MAX_PUSHED + garbage.OLD)]
    collector.step()
    assert gone() is None
    assert kept


def test_where_much_is_made_and_goes_again_the_old_are_left(collector: Collector) -> None:
    cycle, gone = old()
    del cycle
    for _ in range(10):
        for _ in range(garbage.OLD // 4):
            Cycle()
        collector.step()
    assert gone() is not None


def test_much_that_was_thrown_away_goes_with_the_next_look(collector: Collector) -> None:
    cycle, gone = old()
    collector.expect(cycle)
    del cycle
    assert gone() is not None
    collector.step()
    assert gone() is None
    gone = dropped()
    collector.step()
    assert gone() is not None


def test_what_something_still_holds_for_a_while_is_waited_for(collector: Collector) -> None:
    cycle, gone = old()
    collector.expect(cycle)
    for _ in range(100):
        collector.step()
    del cycle
    for _ in range(128):
        collector.step()
    assert gone() is None


def test_what_never_goes_is_not_looked_for_for_ever(
    collector: Collector, monkeypatch: pytest.MonkeyPatch
) -> None:
    cycle, _ = old()
    found: list[object] = []
    collector.expect(cycle)
    monkeypatch.setattr(gc, "collect", lambda *of: found.append(of) or 0)
    for _ in range(10_000):
        collector.step()
    assert len([of for of in found if not of]) == 1 + garbage.MAX_RECHECKS


def test_what_was_there_before_is_not_looked_at(collector: Collector) -> None:
    before = gc.get_freeze_count()
    assert before > 10_000
    collector.close()
    assert gc.get_freeze_count() == 0


def test_it_is_pythons_again_while_no_frame_comes_and_after_the_end() -> None:
    with automatic():
        collector = Collector()
        assert not gc.isenabled()
        collector.pause()
        assert gc.isenabled()
        collector.resume()
        assert not gc.isenabled()
        collector.close()
        assert gc.isenabled()


def test_who_had_turned_it_off_finds_it_off() -> None:
    with automatic():
        gc.disable()
        collector = Collector()
        collector.pause()
        assert not gc.isenabled()
        collector.close()
        assert not gc.isenabled()


def test_one_within_another_leaves_it_as_it_was(collector: Collector) -> None:
    inner = Collector()
    frozen = gc.get_freeze_count()
    inner.close()
    assert gc.get_freeze_count() == frozen


def test_while_something_is_pushed_nothing_is_collected(collector: Collector) -> None:
    cycle, left = old()
    collector.expect(cycle)
    del cycle
    gone = dropped()
    kept = [[] for _ in range(garbage.YOUNG + 2 * garbage.OLD)]
    collector.step(pushed=True)
    assert gone() is not None
    assert left() is not None
    collector.step()
    assert gone() is None
    assert left() is None
    assert kept


def test_a_push_that_lasts_takes_no_more_memory_than_it_may(
    collector: Collector, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(garbage, "MAX_PUSHED", garbage.OLD)
    gone = dropped()
    kept = [[] for _ in range(garbage.OLD + 1000)]
    collector.step(pushed=True)
    assert gone() is None
    assert kept


def test_a_finger_and_a_gamepad_put_it_off(driving: Glass, monkeypatch: pytest.MonkeyPatch) -> None:
    looks: list[bool] = []
    monkeypatch.setattr(Collector, "step", lambda _, *, pushed: looks.append(pushed))

    def looked() -> bool:
        looks.clear()
        driving.until(lambda: len(looks) > 1, "it is not asked to look")
        return looks[-1]

    stick = driving.app.screens["drive"].stick
    assert not looked()
    finger = driving.stage.touch(5, 5)
    finger.touch_down()
    assert looked(), "a finger anywhere"
    finger.touch_up()
    assert not looked()
    stick.lean(1.0, 0.0)
    assert driving.app.inputs.pushed
    monkeypatch.setattr(type(driving.app.inputs), "pushed", True)
    assert looked(), "a stick that no finger has"
