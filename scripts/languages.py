"""The catalogues of the glass: what the sources say, what is translated of it, and the files that the app reads.

    python -m scripts.languages            find every sentence, bring scripts/catalogues/*.po up to date, make widgets/languages/*.mo
    python -m scripts.languages --missing  list what each language still lacks

A sentence is what stands in `tr`, `trn` or `mark` (`widgets/core/language.py`), in Python and in the rules of Kivy. What is no
longer said is kept at the end of a catalogue, as gettext does, until somebody deletes it.
"""

from __future__ import annotations

import argparse
import ast
import io
import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from babel.messages.catalog import Catalog
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "widgets" / "languages"
"""Where the app finds what it reads."""
CATALOGUES = Path(__file__).with_name("catalogues")
"""What people translate; the APK goes without."""
SOURCES = ("widgets", "app")
NAMES = ("de", "es", "fr", "zh_CN")
"""Languages with a catalogue, as in POSIX."""
IN_RULES = re.compile(r"\btrn?\(")
"""Where a rule of Kivy translates."""
Found = tuple[str | tuple[str, str], str | None, str]
"""A sentence, or its singular and plural; its context; and its file. The line is left out: it would change with every edit."""


def sentences(path: Path) -> Iterator[Found]:
    """What a source says."""
    where = str(path.relative_to(ROOT))
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call):
            yield from _of_call(node, where)


def _of_call(node: ast.Call, where: str) -> Iterator[Found]:
    name = node.func.id if isinstance(node.func, ast.Name) else ""
    if isinstance(node.func, ast.Attribute) and node.func.attr == "load_string":
        yield from (
            one
            for rules in node.args
            if isinstance(rules, ast.Constant)
            for one in _of_rules(str(rules.value), where)
        )
    if name in ("tr", "mark", "trn"):
        texts = [one.value if isinstance(one, ast.Constant) else None for one in node.args]
        context = next((one.value for one in node.keywords if one.arg == "context"), None)
        if context is not None:
            texts.insert(1, context.value if isinstance(context, ast.Constant) else None)
        first, second = (*texts, None, None)[:2]
        if name == "trn":
            if not isinstance(first, str) or not isinstance(second, str):
                raise SystemExit(f"{where}, line {node.lineno}: trn takes two sentences as they stand.")
            yield (first, second), None, where
        elif isinstance(first, str) and first:
            yield first, second if isinstance(second, str) else None, where
        elif isinstance(node.args[0], ast.IfExp):
            for branch in (node.args[0].body, node.args[0].orelse):
                one = ast.Call(node.func, [branch, *node.args[1:]], node.keywords, lineno=node.lineno)
                yield from _of_call(one, where)
        elif name == "mark" or isinstance(node.args[0], ast.JoinedStr):
            raise SystemExit(
                f"{where}, line {node.lineno}: {name} takes a sentence as it stands; values go in by format."
            )


def _of_rules(rules: str, where: str) -> Iterator[Found]:
    """What is translated within a text of Kivy's language: each call is Python up to the bracket that closes it."""
    for start in IN_RULES.finditer(rules):
        for end in (at for at in range(start.end(), len(rules)) if rules[at] == ")"):
            try:
                call = ast.parse(rules[start.start() : end + 1], mode="eval").body
            except SyntaxError:
                continue
            if isinstance(call, ast.Call):
                yield from _of_call(call, where)
            break


def titles(path: Path) -> Iterator[Found]:
    """What a layout file that comes with the app writes on the glass."""
    tables = tomllib.loads(path.read_text(encoding="utf-8"))
    for lines in tables.values():
        for line in lines if isinstance(lines, list) else ():
            if isinstance(line, dict):
                for key in ("title", "text"):
                    if line.get(key):
                        yield line[key], None, str(path.relative_to(ROOT))


def template() -> Catalog:
    """Every sentence of the sources."""
    found = Catalog(project="Pilothouse", charset="utf-8", fuzzy=False)
    for folder in SOURCES:
        for path in sorted((ROOT / folder).rglob("*.py")):
            for text, context, where in sentences(path):
                # Babel would take a percent sign and a letter for a place of printf
                message = found.add(text, locations=[(where, 0)], context=context)
                message.flags.discard("python-format")
    for path in sorted((ROOT / "app" / "layouts").glob("*.toml")):
        for text, _, where in titles(path):
            found.add(text, locations=[(where, 0)])
    return found


def catalogue(name: str) -> Catalog:
    """What is translated into a language so far."""
    path = CATALOGUES / f"{name}.po"
    if not path.exists():
        return Catalog(locale=name, project="Pilothouse", charset="utf-8", fuzzy=False)
    with path.open("rb") as file:
        return read_po(file, locale=name)


def brought_up_to_date(name: str, found: Catalog) -> Catalog:
    """The catalogue with all that the sources say; what changed is not guessed at."""
    made = catalogue(name)
    made.update(found, no_fuzzy_matching=True, update_creation_date=False)
    return made


def written(made: Catalog) -> bytes:
    """The text of a catalogue."""
    out = io.BytesIO()
    write_po(
        out, made, width=110, omit_header=False, sort_output=True, include_lineno=False, ignore_obsolete=False
    )
    return out.getvalue()


def compiled(made: Catalog) -> bytes:
    """What the app reads of a catalogue."""
    out = io.BytesIO()
    write_mo(out, made)
    return out.getvalue()


def missing(made: Catalog) -> list[str]:
    """What is not translated, in its English."""

    def lacks(string: str | tuple[str, ...] | list[str] | None) -> bool:
        return not all(string) if isinstance(string, (tuple, list)) else not string

    return [one.id if isinstance(one.id, str) else one.id[0] for one in made if one.id and lacks(one.string)]


def main(argv: list[str] | None = None) -> int:
    """Write the catalogues, or list what they lack; 0."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--missing", action="store_true", help="list what is not translated, and write nothing"
    )
    only_list = parser.parse_args(argv).missing
    found = template()
    for name in NAMES:
        made = brought_up_to_date(name, found)
        lacking = missing(made)
        print(f"{name}: {len(list(found)) - 1 - len(lacking)} of {len(list(found)) - 1} sentences")
        if only_list:
            print("".join(f"  {text}\n" for text in lacking), end="")
            continue
        FOLDER.mkdir(exist_ok=True)
        (CATALOGUES / f"{name}.po").write_bytes(written(made))
        (FOLDER / f"{name}.mo").write_bytes(compiled(made))
    return 0


if __name__ == "__main__":
    sys.exit(main())
