"""The mark: on by presses or by itself, into groups and out, and on its target though the glass changes."""

from __future__ import annotations

import math

from app.inputs.switch_access.scan.plan import Group
from app.inputs.switch_access.scan.scan import Pace, Scan, _words
from app.inputs.switch_access.scan.target import Target


def target(name: str, *, repeatable: bool = False) -> Target:
    return Target(name, name.upper(), lambda: None, repeatable=repeatable)


def tree(*names: str | Group) -> Group:
    return Group(tuple(name if isinstance(name, Group) else target(name) for name in names))


TWO_GROUPS = tree(tree("a", "b"), tree("c", "d"), "e")


def done(scan: Scan, now: float) -> str:
    target = scan.select(now)
    return "" if target is None else target.name


def until(scan: Scan) -> float:
    return math.nan if scan.mark is None else scan.mark.until


def woken(group: Group = TWO_GROUPS, pace: Pace | None = None) -> Scan:
    scan = Scan(pace or Pace())
    scan.show(group, 0.0)
    scan.wake(0.0)
    return scan


def marked(scan: Scan) -> str:
    mark = scan.mark
    return "" if mark is None else f"{mark.kind} {'+'.join(one.name for one in mark.targets)}"


def test_asleep_nothing_stands_out_and_the_first_press_only_shows_where_it_begins() -> None:
    scan = Scan(Pace())
    scan.show(TWO_GROUPS, 0.0)
    assert marked(scan) == ""
    assert scan.select(1.0) is None
    assert marked(scan) == "group a+b"


def test_next_goes_round_and_a_group_is_gone_into() -> None:
    scan = woken()
    scan.next(1.0)
    assert marked(scan) == "group c+d"
    assert scan.select(2.0) is None
    assert marked(scan) == "item c"
    scan.next(3.0)
    scan.next(4.0)
    assert marked(scan) == "item c"


def test_what_is_done_begins_anew_at_the_first_group_and_what_is_repeatable_stays() -> None:
    scan = woken(tree("a", Group((target("b"), target("louder", repeatable=True)))))
    scan.next(1.0)
    scan.select(1.5)
    scan.next(2.0)
    assert done(scan, 3.0) == "louder"
    assert marked(scan) == "item louder"
    scan.next(3.5)
    assert done(scan, 4.0) == "b"
    assert marked(scan) == "item a"


def test_back_leaves_the_group_and_goes_backwards_on_the_top_level() -> None:
    scan = woken()
    scan.next(1.0)
    scan.select(2.0)
    scan.back(3.0)
    assert marked(scan) == "group c+d"
    scan.back(4.0)
    scan.back(5.0)
    assert marked(scan) == "item e"


def test_a_step_that_was_meant_as_a_hold_is_taken_back() -> None:
    scan = woken()
    scan.next(1.0)
    scan.undo(1.6)
    assert marked(scan) == "group a+b"


def test_by_itself_it_steps_with_the_interval_and_stays_longer_on_the_first() -> None:
    scan = woken(tree("a", "b", "c"), Pace(by_itself=True, interval=1.0, first=0.7))
    assert until(scan) == 1.7
    assert not scan.update(1.6)
    assert scan.update(1.7)
    assert marked(scan) == "item b"
    assert not scan.update(2.6)
    assert scan.update(2.75)
    assert marked(scan) == "item c"


def test_it_waits_while_the_switch_is_down() -> None:
    scan = woken(tree("a", "b"), Pace(by_itself=True, interval=1.0, first=0.0))
    assert not scan.update(1.5, wait=True)
    assert not scan.update(2.4)
    assert scan.update(2.5)


def test_by_itself_it_goes_round_so_often_then_up_then_to_sleep() -> None:
    scan = woken(TWO_GROUPS, Pace(by_itself=True, interval=1.0, first=0.0, loops=2))
    scan.select(0.0)
    seen = [marked(scan), *(marked(scan) for step in range(1, 20) if scan.update(float(step)))]
    inside = ["item a", "item b", "back a+b"]
    assert seen[:7] == [*inside, *inside, "group a+b"]
    assert seen[7:] == ["group c+d", "item e", "group a+b", "group c+d", "item e", ""]


def test_with_one_switch_the_way_out_of_a_group_is_one_of_its_steps() -> None:
    scan = woken(TWO_GROUPS, Pace(by_itself=True, interval=1.0, first=0.0))
    scan.select(0.0)
    scan.update(1.0)
    scan.update(2.0)
    assert marked(scan) == "back a+b"
    assert done(scan, 2.5) == ""
    assert marked(scan) == "group a+b"


def test_two_switches_wait_for_ever() -> None:
    scan = woken()
    assert not scan.update(1e6)
    assert marked(scan) == "group a+b"
    assert math.isnan(until(scan))


def test_it_stays_on_its_target_though_another_comes_before_it() -> None:
    scan = woken(tree("a", "b"))
    scan.next(1.0)
    scan.show(tree("new", "a", tree("b", "c")), 2.0)
    assert marked(scan) == "item b"
    assert scan.depth == 1


def test_what_was_marked_and_is_gone_leaves_the_mark_at_the_first() -> None:
    scan = woken(tree("a", "b"))
    scan.next(1.0)
    scan.show(tree("a", "c"), 2.0)
    assert marked(scan) == "item a"


def test_another_screen_begins_at_its_first_though_the_same_is_there() -> None:
    scan = woken(tree("a", "b"))
    scan.next(1.0)
    scan.show(tree("c", "b"), 2.0, fresh=True)
    assert marked(scan) == "item c"


def test_a_screen_with_nothing_to_do_marks_nothing_until_there_is_something() -> None:
    scan = woken(tree())
    scan.next(1.0)
    assert (marked(scan), done(scan, 2.0)) == ("", "")
    scan.show(tree("a"), 3.0)
    assert marked(scan) == "item a"


def test_a_group_is_called_by_its_containers_else_by_where_it_begins_and_ends() -> None:
    def thing(words: str, *group: str) -> Target:
        return Target(words, words, lambda: None, group=group)

    bar = [thing("Back", "Top bar"), thing("Mode", "Top bar"), thing("Before it moves: 4 of 5", "Top bar")]
    assert _words(Group(tuple(bar))) == "Back to Before it moves"
    assert _words(Group(tuple(bar), "Top bar")) == "Top bar"
    assert _words(Group((*bar, thing("Loop")))) == "Top bar and Loop"
    assert _words(Group((*bar, thing("Loop"), thing("Random"), thing("Report")))) == "Top bar to Report"
