"""Sentences are for people: programs go by codes.

A sentence of a message (`text`, `message`, `reason`, `sentence`) may be shown, joined, tested for being empty and compared with
one that was shown before. It is never looked into and never compared with a known one: whoever reworded or translated it would
change what the program does. What programs need stands beside it: a code, an actor's id, parameters, a phase.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.core.codes import Code
from tests.looped import looped

ROOT = Path(__file__).parents[1]
READERS = ("app", "widgets", "robotside", "bridge", "sim")
TELLERS = ("robotside", "sim")
SENTENCES = {"text", "message", "reason", "sentence"}
"""Fields that hold a sentence."""
LOOKS = {
    *("startswith", "endswith", "find", "rfind", "index", "rindex", "count", "removeprefix", "removesuffix"),
    *("partition", "rpartition", "split", "rsplit"),
}
"""Methods that look into a text."""
PATTERNS = {"match", "fullmatch", "search", "findall", "finditer", "sub"}
SAYS = {"say", "_say"}
FIGURES = {
    "widgets/instruments/commanded_motion.py": "its texts are figures, and the dash stands for none",
    "widgets/core/quantities.py": "its texts are figures, and the dash stands for none",
    "widgets/parts/labels.py": "its text is any that is fitted into its room, and only its width counts",
    "app/screens/parts/field_chooser.py": "its text is what somebody types to search by",
}
"""Files with a field of such a name that holds no sentence, and why."""


def trees(*folders: str) -> Iterator[tuple[str, ast.Module]]:
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*.py")):
            if "msgs" not in path.relative_to(ROOT).parts:
                yield str(path.relative_to(ROOT)), ast.parse(path.read_text())


def bare(node: ast.expr) -> ast.expr:
    """What `str(...)`, `.lower()` and the like are of."""
    while isinstance(node, ast.Call):
        if isinstance(node.func, ast.Attribute) and node.func.attr in ("lower", "casefold", "strip", "upper"):
            node = node.func.value
        elif isinstance(node.func, ast.Name) and node.func.id == "str" and node.args:
            node = node.args[0]
        else:
            break
    return node


def is_sentence(node: ast.expr) -> bool:
    node = bare(node)
    return isinstance(node, ast.Attribute) and node.attr in SENTENCES


def is_known(node: ast.expr) -> bool:
    """A text that stands in the program: a literal that is not empty, or a constant."""
    if isinstance(node, ast.Tuple | ast.List | ast.Set):
        return any(is_known(item) for item in node.elts)
    if isinstance(node, ast.JoinedStr):
        return True
    if isinstance(node, ast.Constant):
        return isinstance(node.value, str) and bool(node.value)
    name = node.id if isinstance(node, ast.Name) else node.attr if isinstance(node, ast.Attribute) else ""
    return name.isupper()


def reads(node: ast.AST) -> bool:
    """Whether `node` looks into a sentence, or compares one with a known one."""
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        if isinstance(node.ops[0], ast.In | ast.NotIn) and any(map(is_sentence, node.comparators)):
            return True
        return any(map(is_sentence, sides)) and any(map(is_known, sides))
    if isinstance(node, ast.Subscript):
        return is_sentence(node.slice)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        looks = node.func.attr in LOOKS and is_sentence(node.func.value)
        return looks or (node.func.attr in (*PATTERNS, "get") and any(map(is_sentence, node.args)))
    return False


def found(source: str) -> list[str]:
    return [ast.unparse(node) for node in ast.walk(ast.parse(source)) if reads(node)]


@pytest.mark.parametrize(
    "source",
    [
        "'pressed' in post.value.text",
        "event.text == 'STOP pressed.'",
        "outcome.reason == STILL_SENDING",
        "state.sentence not in ('Lost.', '')",
        "mission.sentence.lower().startswith('accepted')",
        "re.findall('[a-z]+', event.text.lower())",
        "LIKE.fullmatch(str(answer.message))",
        "WORDS.get(status.reason)",
        "WORDS[status.reason]",
    ],
)
def test_who_reads_a_sentence_is_found(source: str) -> None:
    assert found(source)


@pytest.mark.parametrize(
    "source",
    [
        "event.text or 'None.'",
        "if event.text == '': pass",
        "shown.text != now.text",
        "f'{answer.message} So.'",
    ],
)
def test_who_shows_a_sentence_is_left_alone(source: str) -> None:
    assert not found(source)


def test_no_logic_reads_a_sentence() -> None:
    readers = {
        f"{path}:{node.lineno}: {ast.unparse(node)}"
        for path, tree in trees(*READERS)
        for node in ast.walk(tree)
        if path not in FIGURES and reads(node)
    }
    assert readers == set()


def called(node: ast.Call) -> str:
    return node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")


def tells_without_a_code(node: ast.Call) -> bool:
    """Whether a call tells a sentence that has no code. Types hold the rest: only a `Notice` can be told."""
    name = called(node)
    if name == "Event" and node.keywords:
        given = {word.arg for word in node.keywords}
        return "text" in given and not ({"code", None} & given)
    if name in ("Refusal", "NotRecorded"):
        return any(isinstance(arg, ast.Constant | ast.JoinedStr) for arg in node.args)
    return name in SAYS and len(node.args) > 1 and isinstance(node.args[1], ast.Constant | ast.JoinedStr)


def test_no_event_and_no_refusal_is_without_a_code() -> None:
    without = {
        f"{path}:{node.lineno}"
        for path, tree in trees(*TELLERS)
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and tells_without_a_code(node)
    }
    assert without == set()


def codes_in(node: ast.AST) -> set[Code]:
    return {
        Code[each.attr]
        for each in ast.walk(node)
        if isinstance(each, ast.Attribute) and isinstance(each.value, ast.Name) and each.value.id == "Code"
    }


def notices() -> Iterator[tuple[str, set[Code], set[str]]]:
    """Where each notice is made, of which code it may be, and which parameters it is given."""
    for path, tree in trees("robotside"):
        scopes = [each for each in ast.walk(tree) if isinstance(each, ast.FunctionDef)]
        for node in ast.walk(tree):
            if not (isinstance(node, ast.Call) and called(node) == "Notice"):
                continue
            scope = min(
                (one for one in scopes if one.lineno <= node.lineno <= (one.end_lineno or 0)),
                key=lambda one: (one.end_lineno or 0) - one.lineno,
                default=tree,
            )
            given = {word.arg or "" for word in node.keywords} - {"actor_id"}
            yield f"{path}:{node.lineno}", codes_in(node.args[0]) or codes_in(scope) or codes_in(tree), given


def test_each_notice_names_what_its_code_says() -> None:
    wrong = [
        where for where, codes, given in notices() if not any(set(one.parameters) == given for one in codes)
    ]
    assert wrong == []


def test_each_code_is_told_somewhere() -> None:
    told = {code for _, tree in trees(*TELLERS) for code in codes_in(tree)}
    logged = codes_in(ast.parse((ROOT / "app" / "frame_pacing.py").read_text()))
    """By the app, which elsewhere only reads codes."""
    assert set(Code) - told - logged == set()


@looped("code", Code)
def test_a_code_is_its_name_and_says_what_it_means(code: Code) -> None:
    assert code.value == code.name.lower()
    assert code.meaning.endswith(".")
    assert all(name.isidentifier() and name.islower() for name in code.parameters)
