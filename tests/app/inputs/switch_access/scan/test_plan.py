"""The tree: groups of four at most, the frequent cheap, neighbours together, and the same for as long as a session lasts."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator

import pytest

from app.inputs.switch_access.scan.plan import MAX_CHILDREN, Group, Planner, cost, leaves, plan
from app.inputs.switch_access.scan.target import Target

FALLING = {f"t{number}": 1000 * 0.8**number for number in range(16)}


def target(name: str, *, group: tuple[str, ...] = (), fixed: bool = False, intent: str = "") -> Target:
    return Target(name, name, lambda: None, group=group, fixed=fixed, intent=intent)


def targets(count: int, group: tuple[str, ...] = ()) -> list[Target]:
    return [target(f"{'.'.join(group)}t{number}", group=group) for number in range(count)]


def groups(group: Group) -> Iterator[Group]:
    yield group
    for child in group.children:
        if isinstance(child, Group):
            yield from groups(child)


def mean(tree: Group, used: dict[str, float]) -> float:
    costs = cost(tree)
    return sum(costs[name] * times for name, times in used.items()) / sum(used.values())


@pytest.mark.parametrize("count", [0, 1, 4, 5, 16, 17, 40, 150])
@pytest.mark.parametrize("used", [{}, FALLING])
def test_everything_is_reached_by_groups_of_at_most_four(count: int, used: dict[str, float]) -> None:
    there = targets(count)
    tree = plan(there, used)
    assert sorted(one.name for one in leaves(tree)) == sorted(one.name for one in there)
    assert all(len(group.children) <= MAX_CHILDREN for group in groups(tree))
    assert all(len(group.children) > 1 for group in groups(tree) if group is not tree)


def test_nothing_known_they_stay_in_the_order_of_the_glass() -> None:
    there = targets(14)
    assert list(leaves(plan(there))) == there


@pytest.mark.parametrize(("falls", "better"), [(0.8, 1.0), (0.65, 0.95)])
def test_what_is_done_often_costs_no_more_than_in_rows_and_columns_and_less_where_it_is_most_of_all(
    falls: float, better: float
) -> None:
    used = {f"t{number}": 1000 * falls**number for number in range(16)}
    rows = sorted(row + column + 2 for row in range(4) for column in range(4))
    by_rows = sum(presses * times for presses, times in zip(rows, used.values(), strict=True))
    tree = plan(targets(16), used)
    assert mean(tree, used) <= better * by_rows / sum(used.values())
    costs = cost(tree)
    assert [costs[name] for name in used] == sorted(costs[name] for name in used)


def test_neighbours_in_one_container_stay_together_under_its_name() -> None:
    there = [*targets(3, ("Bar",)), *targets(6, ("List",)), *targets(2, ("Bar",))]
    tree = plan(there)
    named = {
        child.words: [one.name for one in leaves(child)]
        for child in tree.children
        if isinstance(child, Group)
    }
    assert named == {
        "Bar": ["Bart0", "Bart1", "Bart2", "Bart0", "Bart1"],
        "List": [f"Listt{number}" for number in range(6)],
    }


def test_a_row_of_a_keyboard_stays_as_it_is_though_one_of_its_letters_is_frequent() -> None:
    row = [target(letter, group=("Keys", "Row 1"), fixed=True) for letter in "qwertz"]
    tree = plan([*row, *targets(3)], {"z": 500.0})
    kept = [group for group in groups(tree) if group.words == "Row 1"]
    assert [one.name for one in leaves(kept[0])] == list("qwertz")
    assert len(kept[0].children) == 6


def test_an_intent_used_by_any_method_makes_its_button_cheap() -> None:
    there = [*targets(12), target("drive.pause", intent="lights")]
    before = cost(plan(there))["drive.pause"]
    assert cost(plan(there, {"intent:lights": 40.0}))["drive.pause"] == 1 < before


def test_a_tree_stays_in_a_session_and_what_is_gone_only_leaves_its_place() -> None:
    planner = Planner({"drive": FALLING})
    there = targets(16)
    before = cost(planner.tree("drive", there))
    without = planner.tree("drive", there[1:])
    assert "t0" not in cost(without)
    assert cost(planner.tree("drive", there)) == before


def test_what_is_marked_does_what_it_means_now() -> None:
    planner = Planner({})
    planner.tree("drive", [target("pause"), target("other")])
    fresh = Target("pause", "Resume", lambda: None)
    assert fresh in list(leaves(planner.tree("drive", [fresh, target("other")])))


def test_something_new_gets_a_place() -> None:
    planner = Planner({})
    planner.tree("connect", targets(3))
    assert len(list(leaves(planner.tree("connect", targets(9))))) == 9


def test_what_was_learned_on_one_screen_says_nothing_of_another() -> None:
    planner = Planner({"drive": {"t9": 100.0}})
    assert cost(planner.tree("drive", targets(16)))["t9"] == 1
    assert cost(planner.tree("tasks", targets(16)))["t9"] > 1


def test_nothing_of_the_glass_is_kept_beyond_what_it_is_called() -> None:
    class Widget:
        """Something that must be able to go."""

    planner, widget = Planner({}), Widget()
    gone = weakref.ref(widget)
    planner.tree("drive", [Target("a", "A", lambda: None, key=widget), target("b")])
    del widget
    gc.collect()
    assert gone() is None
