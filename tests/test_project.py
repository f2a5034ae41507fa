"""What the repository promises about itself."""

from __future__ import annotations

import ast
import json
import pydoc
import re
import subprocess
import sys
import tomllib
from functools import cache
from pathlib import Path

import pytest

from bridge.generate.modules import MARK
from scripts import code_table, permission_table
from scripts.room_map import imported_names
from scripts.topic_table import DOCUMENTS, with_table
from tests.lacking import lacking
from tests.looped import looped

ROOT = Path(__file__).parents[1]
SOURCES = [
    p
    for d in ("app", "bridge", "widgets", "robotside", "sim", "bench", "examples")
    for p in (ROOT / d).rglob("*.py")
]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


@cache
def parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text())


def canonical(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def body_length(node: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    first = node.body[0]
    spoken = (
        isinstance(first, ast.Expr)
        and isinstance(first.value, ast.Constant)
        and isinstance(first.value.value, str)
    )
    start = first.end_lineno if spoken else node.lineno
    return node.end_lineno - start


def test_the_table_of_roles_is_the_one_of_the_permissions():
    text = permission_table.DOCUMENT.read_text()
    assert permission_table.with_table(text) == text, "run python scripts/permission_table.py"


def test_the_code_table_is_the_one_of_the_catalogue():
    text = code_table.DOCUMENT.read_text()
    assert code_table.with_table(text) == text, "run python scripts/code_table.py"


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_the_topic_table_is_the_one_of_the_code(document):
    text = document.read_text()
    assert with_table(text) == text, "run python scripts/topic_table.py"


RECIPES = {
    title: rest
    for title, _, rest in (
        part.removeprefix("To add ").partition("\n")
        for part in re.split(r"^## ", (ROOT / "CONTRIBUTING.md").read_text(), flags=re.MULTILINE)
        if part.startswith("To add ")
    )
}
QUOTED = [(title, quoted) for title, recipe in RECIPES.items() for quoted in re.findall(r"`([^`]+)`", recipe)]


@cache
def known_names() -> set[str]:
    """Every class, function, attribute, key and task that the sources speak of."""
    nodes = [node for path in SOURCES for node in ast.walk(parsed(path))]
    named = {node.name for node in nodes if isinstance(node, ast.ClassDef | ast.FunctionDef)}
    used = {node.attr for node in nodes if isinstance(node, ast.Attribute)}
    words = {node.value for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str)}
    targets = {node.id for node in nodes if isinstance(node, ast.Name)}
    return named | used | words | targets


def exists(quoted: str) -> bool:
    """What a recipe quotes, a path (NAME stands for any), a dotted name or a plain one, is there."""
    if quoted.startswith("python -m "):
        return pydoc.locate(quoted.split()[2]) is not None
    path = quoted.removeprefix("python ")
    if "/" in path:
        return any(ROOT.glob(path.replace("NAME", "*").replace("ROOM", "**").rstrip("/")))
    parts = quoted.removesuffix("()").split(".")
    if (ROOT / parts[0]).is_dir():
        return pydoc.locate(quoted) is not None
    return set(parts) <= known_names()


def test_there_is_a_recipe_for_each_part_that_grows_and_each_fits_fifteen_lines():
    grows = [
        "a widget",
        "a vehicle",
        "a kind of vehicle",
        "a behaviour or a task",
        "a topic or message",
        "a gateway",
    ]
    assert list(RECIPES) == grows
    assert all(len(recipe.strip().splitlines()) <= 15 for recipe in RECIPES.values())


@looped(("title", "quoted"), QUOTED)
def test_everything_that_a_recipe_names_exists(title, quoted):
    assert exists(quoted)


@pytest.mark.parametrize(
    "wrong",
    [
        "python -m bridge.nothing x",
        "robotside/gateways/nothing/NAME.py",
        "sim.robot.ROBOTZ",
        "blackbord",
        "Guide.nope",
    ],
)
def test_a_name_that_a_recipe_must_not_use_is_noticed(wrong):
    assert not exists(wrong)


def test_every_extra_is_pinned():
    extras = PROJECT["project"]["optional-dependencies"].values()
    wanted = [name for names in (PROJECT["project"]["dependencies"], *extras) for name in names]
    pinned = {canonical(line.split("==")[0]) for line in (ROOT / "constraints.txt").read_text().splitlines()}
    assert not [name for name in wanted if canonical(re.split(r"[<>=!~]", name)[0]) not in pinned]


def test_the_pins_name_no_registry():
    lines = (ROOT / "constraints.txt").read_text().splitlines()
    assert all(line.startswith("#") or re.fullmatch(r"[\w.-]+==[\w.]+", line) for line in lines)


def test_the_javascript_libraries_and_all_that_they_need_are_pinned_and_name_no_registry():
    package = json.loads((ROOT / "tests/clients/package.json").read_text())
    own = {
        f"{user}/node_modules/{name}": version
        for user, names in package["overrides"].items()
        for name, version in names.items()
    }
    wanted = package["dependencies"] | own
    assert {"roslib", "soap"} <= set(wanted)
    assert all(re.fullmatch(r"\d+\.\d+\.\d+", version) for version in wanted.values())
    lock = ROOT / "tests/clients/node_modules/.package-lock.json"
    if not lock.exists():
        lacking("roslib", "make setup-js installs it")
    found = json.loads(lock.read_text())["packages"]
    installed = {path.removeprefix("node_modules/"): entry["version"] for path, entry in found.items()}
    assert installed == wanted


def test_no_file_is_over_500_lines_and_no_function_over_40():
    lines = {path: path.read_text().splitlines() for path in SOURCES}
    files = [path.name for path, found in lines.items() if len(found) > 500 and MARK not in found[0]]
    functions = [
        f"{path.name}:{node.lineno} {node.name}"
        for path in SOURCES
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and body_length(node) > 40
    ]
    assert not files + functions


def is_a_table(node: ast.ClassDef) -> bool:
    """It lists values and does next to nothing, as an enumeration does."""
    return sum(body_length(part) for part in node.body if isinstance(part, ast.FunctionDef)) < 10


def test_no_class_is_over_250_lines_unless_it_is_a_table():
    classes = [
        f"{path.name} {node.name}"
        for path in SOURCES
        if "msgs" not in path.parts
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.ClassDef) and node.end_lineno - node.lineno >= 250 and not is_a_table(node)
    ]
    assert not classes


def test_the_license_is_apache_2():
    text = (ROOT / "LICENSE").read_text()
    assert "Apache License" in text
    assert "END OF TERMS AND CONDITIONS" in text


def test_each_verb_of_the_makefile_says_what_it_does():
    listed = subprocess.run(
        ["make", "-s", "help"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    verbs = {line.split()[0] for line in listed.splitlines()}
    daily = {"run", "demo", "test", "test-fast", "test-slow", "bench", "android-check", "gallery", "lint"}
    assert {"setup", "voice", "setup-test", "setup-js"} | daily <= verbs


def test_the_ten_lines_of_the_readme_are_a_program_of_the_examples():
    shown = re.search(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL).group(1)
    assert (ROOT / "examples" / "circle.py").read_text().endswith(shown)


def test_the_widgets_of_the_documentation_are_a_program_of_the_examples():
    shown = re.search(r"```python\n(.*?)```", (ROOT / "docs/architecture.md").read_text(), re.DOTALL).group(1)
    assert (ROOT / "examples" / "two_widgets.py").read_text().endswith(f'"""\n\n{shown}')


NAMED_OTHERWISE = {
    "ruamel": "ruamel.yaml",
    "hibari": "hibari-tts",
    "PIL": "pillow",
    "paho": "paho-mqtt",
    "kivy_garden": "kivy-garden.mapview",
    "pybullet_data": "pybullet",
}
WHO_INSTALLS = {
    "app": "handheld",
    "widgets": "handheld",
    "robotside": "robot",
    "sim": "sim",
    "bridge/generate": "dev",
}


ALSO = {"app": ("voice", "vosk", "espeak", "mdns"), "robotside": ("gateways", "mdns", "video")}
"""Extras that a folder makes use of where they are installed."""


FOR_EXTRAS = {"bridge/core/fence.py": ("handheld", "robot")}
"""A module that only the folders of these extras import, and that needs what they install."""


def installed_by(*extras):
    optional = PROJECT["project"]["optional-dependencies"]
    names = PROJECT["project"]["dependencies"] + [name for extra in extras for name in optional[extra]]
    return {canonical(re.split(r"[<>=!~]", name)[0]) for name in names}


@pytest.mark.parametrize("module", FOR_EXTRAS)
def test_a_module_for_some_extras_needs_what_each_of_them_installs_and_nothing_beside_it_imports_it(module):
    wanted = (
        {name.split(".")[0] for name in imported_names(ROOT / module)} - sys.stdlib_module_names - {"bridge"}
    )
    assert all(wanted <= installed_by(extra) for extra in FOR_EXTRAS[module])
    dotted = module.removesuffix(".py").replace("/", ".")
    beside = [
        path
        for path in (ROOT / module.split("/")[0]).rglob("*.py")
        if any(name.startswith(f"{dotted}.") for name in imported_names(path))
    ]
    assert not beside


@pytest.mark.parametrize("folder", ["bridge", *WHO_INSTALLS])
def test_every_import_is_installed_by_the_folders_own_extra(folder):
    names = PROJECT["project"]["dependencies"] + PROJECT["project"]["optional-dependencies"].get(
        WHO_INSTALLS.get(folder), []
    )
    names = names + [
        name for also in ALSO.get(folder, ()) for name in PROJECT["project"]["optional-dependencies"][also]
    ]
    installed = {canonical(re.split(r"[<>=!~]", name)[0]) for name in names}
    wanted = {
        module.split(".")[0]
        for path in (ROOT / folder).rglob("*.py")
        for module in imported_names(path)
        if path.name != "__main__.py" or folder != "robotside"
        if "generate" not in path.parts or folder != "bridge"
        if path.relative_to(ROOT).as_posix() not in FOR_EXTRAS
    }
    foreign = (
        wanted
        - sys.stdlib_module_names
        - {"app", "bridge", "widgets", "robotside", "sim", "jnius", "android"}
    )
    assert not [name for name in foreign if canonical(NAMED_OTHERWISE.get(name, name)) not in installed]
