"""Addresses of one robot: what proves alike is one, what only says so never hides who has not confirmed."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from app.stop.same_robot import Row, SameRobots, Seen

PHASES = ["released", "moves", "stopped", "sent", "lost", "no_answer"]
DONE = ("stopped", "released")


def seen(
    url: str, phase: str = "sent", *, proven: str = "", says: tuple[str, ...] = (), foreign: bool = False
) -> Seen:
    return Seen(Row(url, url, phase, foreign=foreign), proven, says)


def urls(rows: list[Row]) -> list[tuple[str, str, int]]:
    return [(row.url, row.phase, row.also) for row in rows]


def test_addresses_that_say_and_prove_nothing_are_robots_of_their_own() -> None:
    assert urls(SameRobots().counted([seen("a"), seen("b")])) == [("a", "sent", 0), ("b", "sent", 0)]


def test_one_key_at_two_addresses_is_one_robot_by_what_it_says_itself() -> None:
    rows = SameRobots().counted(
        [seen("a", "lost", proven="F"), seen("b", "stopped", proven="F"), seen("c", proven="G")]
    )
    assert urls(rows) == [("b", "stopped", 1), ("c", "sent", 0)]


def test_what_was_one_once_stays_one_until_it_proves_another_key() -> None:
    same = SameRobots()
    same.counted([seen("a", says=("boot",)), seen("b", says=("boot",))])
    assert urls(same.counted([seen("a"), seen("b")])) == [("a", "sent", 1)]
    assert urls(same.counted([seen("a"), seen("b", proven="F")])) == [("a", "sent", 0), ("b", "sent", 0)]
    same.forget()
    assert len(same.counted([seen("a"), seen("b")])) == 2


def test_three_addresses_linked_by_different_words_are_one_robot() -> None:
    listed = [seen("a", says=("boot",)), seen("b", says=("identity",)), seen("c", says=("identity", "boot"))]
    assert urls(SameRobots().counted(listed)) == [("a", "sent", 2)]


@given(
    st.lists(
        st.tuples(
            st.sampled_from("abcdef"),
            st.sampled_from(PHASES),
            st.sampled_from(["", "", "F", "G"]),
            st.lists(st.sampled_from(["boot", "identity", "x"]), max_size=2).map(tuple),
            st.booleans(),
        ),
        unique_by=lambda one: one[0],
    )
)
def test_no_claim_hides_who_has_not_confirmed_nor_lets_go_of_who_is_held(
    listed: list[tuple[str, str, str, tuple[str, ...], bool]],
) -> None:
    rows = SameRobots().counted(
        [
            seen(url, phase, proven=proven, says=says, foreign=held)
            for url, phase, proven, says, held in listed
        ]
    )
    assert sum(1 + row.also for row in rows) == len(listed)
    proofs = {url: proven for url, _, proven, _, _ in listed}
    for url, phase, proven, _, _ in listed:
        if not proven and phase not in DONE:
            assert any(row.phase not in DONE for row in rows if not proofs[row.url]), url
    assert len({one[2] for one in listed if one[2]}) == sum(bool(proofs[row.url]) for row in rows)
    assert any(row.foreign for row in rows) == any(held for *_, held in listed)
    unconfirmed = sum(1 for row in rows if not proofs[row.url] and row.phase in DONE)
    assert unconfirmed <= sum(1 for _, phase, proven, _, _ in listed if not proven and phase in DONE)


def test_what_a_proven_robot_says_makes_no_two_others_one() -> None:
    listed = [
        seen("a", says=("boot",)),
        seen("b", proven="F", says=("boot", "identity")),
        seen("c", says=("identity",)),
    ]
    assert len(SameRobots().counted(listed)) == 3
