"""Scores of the forms, as published, and that they are kept."""

from __future__ import annotations

import pytest

from app.study.questionnaires import FILE, Workload, Workloads, raw_tlx, sus

TLX = {"mental": 35, "physical": 10, "temporal": 60, "performance": 25, "effort": 100, "frustration": 0}
SUS = {str(number): answer for number, answer in enumerate((4, 2, 5, 1, 4, 2, 5, 1, 4, 2), 1)}


def test_the_raw_load_is_the_mean_of_the_six_scales():
    assert raw_tlx(TLX) == pytest.approx(230 / 6)
    assert raw_tlx(dict.fromkeys(TLX, 0)) == 0.0
    assert raw_tlx(dict.fromkeys(TLX, 100)) == 100.0


@pytest.mark.parametrize(
    ("answers", "score"),
    [
        (SUS, 85.0),
        (dict.fromkeys(SUS, 3), 50.0),
        ({key: 5 if int(key) % 2 else 1 for key in SUS}, 100.0),
        ({key: 1 if int(key) % 2 else 5 for key in SUS}, 0.0),
    ],
)
def test_usability_is_scored_as_published(answers, score):
    assert sus(answers) == score


@pytest.mark.parametrize(
    ("score", "answers", "said"),
    [
        (raw_tlx, {**TLX, "effort": 105}, "effort is 105: 0 to 100 in steps of 5 is allowed"),
        (raw_tlx, {**TLX, "effort": 33}, "effort is 33: 0 to 100 in steps of 5 is allowed"),
        (raw_tlx, {key: value for key, value in TLX.items() if key != "mental"}, "mental has no answer"),
        (raw_tlx, {**TLX, "boredom": 5}, "boredom is no part of it"),
        (sus, {**SUS, "3": 0}, "Item 3 is 0: 1 to 5 is allowed"),
        (sus, {}, "1, 2, 3, 4, 5, 6, 7, 8, 9, 10 has no answer"),
    ],
)
def test_what_cannot_be_scored_is_refused_with_what_is_allowed(score, answers, said):
    with pytest.raises(ValueError, match=said):
        score(answers)


def test_forms_are_there_after_the_apps_end(tmp_path):
    one = Workload(
        form="tlx", answers=TLX, order=["effort", "mental"], seconds={"effort": 3.5}, at=100.0, method="voice"
    )
    two = Workload(form="sus", answers=SUS, at=200.0)
    store = Workloads(tmp_path / "responses")
    store.put(one)
    store.put(two)
    again = Workloads(tmp_path / "responses")
    assert again.kept == [one, two]
    assert again.scores("sus") == [(200.0, 85.0)]


def test_a_form_that_cannot_be_scored_is_not_kept(tmp_path):
    store = Workloads(tmp_path)
    with pytest.raises(ValueError, match="has no answer"):
        store.put(Workload(form="tlx", answers={}))
    assert store.kept == []


def test_a_line_that_makes_no_sense_is_left_out(tmp_path):
    Workloads(tmp_path).put(Workload(form="sus", answers=SUS))
    path = tmp_path / FILE
    path.write_bytes(b'{"form": "tlx", "answers": {}}\nrubbish\n\xff\n' + path.read_bytes())
    assert [one.form for one in Workloads(tmp_path).kept] == ["sus"]


def test_a_disk_that_fails_is_said_and_the_form_stays_in_memory(tmp_path):
    (tmp_path / "here").write_text("no folder")
    store = Workloads(tmp_path / "here")
    store.put(Workload(form="sus", answers=SUS))
    assert store.problem.startswith("The form")
    assert len(store.kept) == 1


def test_all_can_be_forgotten(tmp_path):
    store = Workloads(tmp_path)
    store.put(Workload(form="sus", answers=SUS))
    store.erase()
    assert Workloads(tmp_path).kept == []
