"""Layout files: a robot's drive screen and its views as tables, and all that is wrong with one, a sentence each.

A file says for which robots it is, how the drive screen is arranged, which instruments and controls sit where, what can be
done by a button, and which views of free panels there are beside it. The app takes the one whose `for` names the robot's
model, else its kind, else `DEFAULT`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from app.layout.layout_faults import FaultList, LayoutError, LayoutFault, place_in
from app.layout.layout_tables import (
    ACTIONS,
    ARRANGEMENTS,
    SAYS,
    SLIDER,
    Action,
    Arrangement,
    Control,
    Instrument,
    Layout,
    LayoutFile,
)
from bridge.core.toml_files import FileFault, read_all

__all__ = [
    "ACTIONS",
    "ARRANGEMENTS",
    "DEFAULT",
    "FOLDER",
    "SAYS",
    "SLIDER",
    "Action",
    "Arrangement",
    "Control",
    "Instrument",
    "Layout",
    "LayoutError",
    "LayoutFault",
    "load",
    "names",
    "owners",
    "parse",
]

FOLDER = Path(__file__).parents[1] / "layouts"
DEFAULT = "patrol"
"""The layout of a robot that none is made for."""


def names(folder: Path = FOLDER) -> list[str]:
    """Names of the layouts there are."""
    return sorted(path.stem for path in folder.glob("*.toml"))


def load(name: str, widgets: Iterable[str], folder: Path = FOLDER) -> Layout:
    """The layout of that name, or in the file of that name where it ends in `.toml`; `widgets` are the names of the catalogue.

    LayoutError with a sentence.
    """
    if name.endswith(".toml"):
        try:
            return parse(name, Path(name).read_text(encoding="utf-8"), widgets)
        except (OSError, UnicodeDecodeError) as error:
            raise LayoutError(f"Layout {name} cannot be read: {error}.") from error
    if name not in names(folder):
        raise LayoutError(f"There is no layout {name!r}; there are: {', '.join(names(folder))}.")
    return parse(name, (folder / f"{name}.toml").read_text(encoding="utf-8"), widgets)


def owners(folder: Path = FOLDER) -> dict[str, str]:
    """Each model and kind of robots to the name of the layout that is made for it; no widget is looked at.

    LayoutError with a sentence, as where two layouts are for one robot.
    """
    found: dict[str, str] = {}
    for name in names(folder):
        try:
            text = (folder / f"{name}.toml").read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise LayoutError(f"Layout {name} cannot be read: {error}.") from error
        file, faults = _read(name, text)
        faults.raise_any()
        for robot in file.robots if file is not None else ():
            if robot in found:
                raise LayoutError(f"Layouts {found[robot]} and {name} are both for {robot}.")
            found[robot] = name
    return found


def parse(name: str, text: str, widgets: Iterable[str]) -> Layout:
    """The layout in TOML text; LayoutError with all that is wrong with it, a sentence each."""
    from app.layout.layout_checks import check  # Kivy has to be set up before a widget is imported

    file, faults = _read(name, text)
    if file is None:
        raise faults.error
    check(f"Layout {name}", file, tuple(widgets), faults)
    faults.raise_any()
    return file.layout(name)


def _read(name: str, text: str) -> tuple[LayoutFile | None, FaultList]:
    """What of the file can be read, and the faults of its tables and keys."""
    where = f"Layout {name}"
    file, found = read_all(text, LayoutFile, where)
    faults = FaultList(text)
    for fault in found:
        faults.add(fault.where, _sentence(fault, where), fault.line)
    return file, faults


def _sentence(fault: FileFault, where: str) -> str:
    """What is wrong with a layout, its tables counted as people count them: `instrument[0].slot` is in instrument 1."""
    table, key = re.fullmatch(r"((?:\w+\[\d+\]\.)*)(.*)", fault.where, re.DOTALL).groups()  # type: ignore[union-attr]
    place = f"{where}{place_in(table)}"
    if fault.known:
        return f"{place}: key is one of {', '.join(fault.known)}, not {key!r}."
    return f"{place}: {key} {fault.reason}." if key else str(fault)
