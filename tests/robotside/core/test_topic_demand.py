"""Who wants an on-demand topic."""

from __future__ import annotations

from robotside.core.topic_demand import Demand


def test_a_topic_is_made_from_the_first_who_wants_it_to_the_last() -> None:
    told: list[tuple[str, bool]] = []
    demand = Demand(lambda topic, wanted: told.append((topic, wanted)))
    for asker, wanted in (("x", True), ("y", True), ("x", True), ("x", False), ("y", False), ("y", False)):
        demand.set("/camera", asker, wanted)
    assert told == [("/camera", True), ("/camera", False)]
