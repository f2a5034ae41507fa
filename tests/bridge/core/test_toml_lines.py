"""Line numbers of the keys of a TOML text."""

from __future__ import annotations

import tomllib

import pytest

from bridge.core.toml_lines import line_of

TEXT = '''\
# a comment with [brackets] and x = 1
name = "yard"
words = """
[not.a.table]
x = 7
"""
sizes = [
    1.0,
    2.0,  # the second
    3.0,
]
near.x = 1

[ground]
length = 3.0

[[cars]]
x = 1

[[cars]]      # the second one
x = 2
colour = [1,
  2, 3]

[cars.door]
open = true

[[cars.wheels]]
size = 0.5

[[cars.wheels]]
size = 0.6

[[cars]]
points = [
  {x = 1, y = 2},

  {x = 3, y = 4},
]
'''


@pytest.mark.parametrize(
    ("where", "line"),
    [
        ("name", 2),
        ("words", 3),
        ("sizes", 7),
        ("sizes[1]", 9),
        ("near.x", 12),
        ("ground", 14),
        ("ground.length", 15),
        ("ground.width", 14),
        ("cars[0].x", 18),
        ("cars[1]", 20),
        ("cars[1].x", 21),
        ("cars[1].colour", 22),
        ("cars[1].door.open", 26),
        ("cars[1].wheels[0].size", 29),
        ("cars[1].wheels[1].size", 32),
        ("cars[2].points[0]", 36),
        ("cars[2].points[1].y", 38),
        ("nothing", 0),
        ("", 0),
    ],
)
def test_a_key_is_found_in_its_line(where: str, line: int) -> None:
    assert line_of(TEXT, where) == line


def test_a_string_or_comment_may_hold_what_divides() -> None:
    text = 'a = "[{,"\nb = [\n  "],",  # ], [\n  \'\'\'\n,[\'\'\',\n  [1, 2],\n]\r\nc = """\\"""\n[x]"""\nd = 1\n'
    assert [line_of(text, where) for where in ("b[0]", "b[1]", "b[2]", "c", "d")] == [3, 4, 6, 8, 10]


def test_each_letter_of_a_text_is_read_a_few_times_however_many_faults_and_entries_it_has(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    read: list[int] = []
    loads = tomllib.loads
    monkeypatch.setattr(tomllib, "loads", lambda text: (read.append(len(text)), loads(text))[1])
    entries = "".join(f"  {number},\n" for number in range(2000))
    text = f"wide = [\n{entries}]\n" + "".join(f"key{number} = 1\n" for number in range(500))
    assert [line_of(text, f"key{number}") for number in range(500)] == list(range(2003, 2503))
    assert line_of(text, "wide[1999]") == 2001
    assert sum(read) < 2 * len(text)
