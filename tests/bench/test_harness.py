"""A bench is repeated, ours and the peer's way in turn."""

from __future__ import annotations

import os
from contextlib import contextmanager
from types import SimpleNamespace

import pytest

from bench import __main__ as command
from bench.support import child
from bench.support.figures import Figure
from bench.support.harness import Context, Sides, measure, names
from bench.support.noise import Noise
from bridge.discovery.domain import VARIABLE, discovery_domain

FIGURES = (
    Figure("cost", "ms", "what it costs", target=2.0, against="the old way"),
    Figure("size", "kB", "how big"),
)


def bench_of(log, *, peer=True, fails=False):
    values = iter([1.0, 5.0, 3.0])

    def ours():
        log.append("ours")
        if fails:
            raise RuntimeError("no")
        return {"cost": next(values), "size": 4.0}

    def theirs():
        log.append("peer")
        return {"cost": 9.0}

    @contextmanager
    def prepare(context):
        log.append("up")
        try:
            yield Sides(ours, theirs if peer else None)
        finally:
            log.append("down")

    return SimpleNamespace(__doc__="How.\n", FIGURES=FIGURES, REPEATS=3, prepare=prepare)


def still():
    return Noise(work=lambda rounds: sum(range(200)))


def test_the_two_sides_take_turns_between_set_up_and_take_down():
    log = []
    measure("x", bench_of(log), Context(), still())
    assert log == ["up", *["ours", "peer"] * 3, "down"]


def test_each_figure_gets_the_samples_of_its_name():
    result = measure("x", bench_of([]), Context(), still())
    cost, size = result.outcomes
    assert cost.ours.values == [1.0, 5.0, 3.0]
    assert (cost.ours.median, cost.peer.median, cost.ratio, cost.verdict) == (3.0, 9.0, 3.0, "MISSED")
    assert (size.ours.values, size.peer.values, size.verdict) == ([4.0] * 3, [], "")
    assert (result.name, result.how) == ("x", "How.")


@pytest.mark.parametrize(("peer", "samples"), [(True, 7), (False, 4)])
def test_the_noise_is_taken_before_between_and_after(peer, samples):
    noise = still()
    measure("x", bench_of([], peer=peer), Context(), noise)
    assert len(noise.slowness) == len(noise.waiting) == len(noise.load) == samples


def test_a_bench_that_fails_is_taken_down():
    log = []
    with pytest.raises(RuntimeError, match="no"):
        measure("x", bench_of(log, fails=True), Context(), still())
    assert log == ["up", "ours", "down"]


def test_every_bench_declares_its_figures_and_says_how_it_measures():
    for name in names():
        source = (command.ROOT / "bench" / f"{name}.py").read_text()
        assert source.startswith('"""')
        assert "\nFIGURES = " in source
        assert "\nREPEATS = " in source
        assert "\ndef prepare(" in source


@pytest.fixture
def only(monkeypatch, tmp_path):
    """Have the command know one bench, and write into a folder of the test."""

    def use(module):
        monkeypatch.setenv(VARIABLE, discovery_domain())  # the command sets another; this one comes back
        monkeypatch.setattr(command, "names", lambda: ["x"])
        monkeypatch.setattr(command, "load", lambda name: module)
        monkeypatch.setattr(command, "OUT", tmp_path / "bench")
        monkeypatch.setattr(command, "PAGE", tmp_path / "performance.md")
        return tmp_path

    return use


def test_a_missed_figure_is_marked_and_is_no_failure(only, capsys):
    folder = only(bench_of([]))
    assert command.main(["x", "--json", str(folder / "all.json"), "--doc", ", in a storm"]) == 0
    told = capsys.readouterr().out
    assert "MISSED" in told
    assert "missed: x.cost" in told
    assert (folder / "bench" / "x.json").exists()
    assert (folder / "all.json").read_text().count('"bench": "x"') == 1
    page = (folder / "performance.md").read_text()
    assert "**missed**" in page
    assert ", in a storm." in page


def test_the_page_alone_is_written_from_what_was_measured_before(only):
    folder = only(bench_of([]))
    assert command.main(["x"]) == 0
    assert not (folder / "performance.md").exists()
    log = []
    only(bench_of(log))
    assert command.main(["--doc"]) == 0
    assert log == []
    assert "## x" in (folder / "performance.md").read_text()


def test_a_crash_is_told_and_is_a_failure(only, capsys):
    folder = only(bench_of([], fails=True))
    assert command.main([]) == 1
    told = capsys.readouterr()
    assert "x: crashed" in told.out
    assert "RuntimeError: no" in told.err
    assert not (folder / "bench" / "x.json").exists()


def test_an_unknown_name_is_the_users_mistake_in_one_sentence(only, capsys):
    only(bench_of([]))
    with pytest.raises(SystemExit) as end:
        command.main(["speed"])
    assert end.value.code == 2
    assert capsys.readouterr().err == "There is no bench 'speed'; there are x.\n"


def test_robots_that_are_measured_are_in_a_domain_of_their_own(monkeypatch):
    """What a bench starts inherits it: robots of others are neither measured nor stopped."""
    monkeypatch.setenv(VARIABLE, "somebody_elses")
    seen = []
    monkeypatch.setattr(command, "run", lambda name, context: seen.append((name, discovery_domain())))
    command.main(["imports", "latency"])
    assert seen == [(name, f"bench-{os.getpid()}") for name in ("imports", "latency")]
    assert child._environment()[VARIABLE] == f"bench-{os.getpid()}"
