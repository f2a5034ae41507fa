"""Round trips are measured sparingly: wherever a HELLO sends them, nobody is flooded by us."""

from __future__ import annotations

from collections import Counter

from app.discovery.known_robots import Entry
from app.discovery.probes import ADDRESS_PERIOD, MAX_AT_ONCE, MEASURE_PERIOD, ProbeSchedule


def robot(host: str, port: int = 8080, silent: float = 0.1) -> Entry:
    return Entry(f"ws://{host}:{port}", "a", silent=silent, probe=(host, port))


def test_each_robot_is_measured_every_three_seconds() -> None:
    probes = ProbeSchedule()
    probes.wants([robot("10.0.0.1")])
    at = [now for now in range(10) if probes.due(float(now))]
    assert at == [0, 3, 6, 9]
    assert MEASURE_PERIOD == 3.0


def test_only_robots_that_are_there_and_have_a_page_are_measured() -> None:
    probes = ProbeSchedule()
    probes.wants([robot("10.0.0.1", silent=5.0), Entry("ws://10.0.0.2:9090", "b", silent=0.1)])
    assert probes.due(0.0) == []


def test_one_address_gets_one_connection_a_second_however_many_robots_name_it() -> None:
    probes = ProbeSchedule()
    probes.wants([robot("10.0.0.1", port) for port in range(1, 51)])
    asked = [one for n in range(50) for one in probes.due(n * ADDRESS_PERIOD)]
    assert Counter(host for _, host, _ in asked) == {"10.0.0.1": 50}
    assert len({port for _, _, port in asked}) == 50, "each has its turn"


def test_few_are_measured_at_once_and_each_has_its_turn() -> None:
    probes = ProbeSchedule()
    probes.wants([robot(f"10.0.0.{n}") for n in range(40)])
    rounds = [probes.due(float(now)) for now in range(5)]
    assert [len(one) for one in rounds] == [MAX_AT_ONCE] * 5
    assert len({url for one in rounds for url, *_ in one}) == 40


def test_nothing_is_remembered_of_robots_that_are_gone() -> None:
    probes = ProbeSchedule()
    for now in range(200):
        probes.wants([robot(f"10.0.{now}.{n}") for n in range(5)])
        probes.due(float(now))
    assert len(probes._robots) <= 5
    assert len(probes._addresses) <= 5
