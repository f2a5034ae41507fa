from __future__ import annotations

from bridge.msgs.pilothouse_msgs import PlaceCandidate
from widgets.core.candidate_letters import candidate_letters


def of(*numbers):
    return candidate_letters([PlaceCandidate(number, 0.0, 0.0, 0.0, 0.5, 0.1) for number in numbers])


def test_letters_stay_with_their_candidates_and_are_never_the_same():
    assert of(2, 1) == ["B", "A"]
    assert of(2, 3) == ["B", "C"]
    assert of(1, 27) == ["1", "27"]
