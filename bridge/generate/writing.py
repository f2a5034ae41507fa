"""Python files of message classes, written from files of ROS text."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import bridge.msgs
from bridge.generate.find import definitions
from bridge.generate.library import Library, known
from bridge.generate.model import TextError
from bridge.generate.modules import MARK, package_module

__all__ = ["generate"]


def generate(files: Iterable[Path], out: Path, package: str | None = None) -> list[Path]:
    """Write the classes of `files` into `out`, a module for each package; the written files, by alphabet.

    Nothing is written unless everything is right, and nothing over a file that was not generated. TextError says what is
    wrong, OSError that it cannot be written.
    """
    home = "bridge.msgs" if out.resolve() == Path(bridge.msgs.__file__).resolve().parent else ""
    library = Library(definitions(files, package, known))
    texts = {f"{name}.py": package_module(name, library, home) for name in library.packages}
    stale = {path for name in library.packages for path in _there(out, name)} - {out / path for path in texts}
    for path in sorted(stale | {out / path for path in texts}):
        if (
            path.is_file()
            and MARK not in path.read_text(encoding="utf-8", errors="replace").partition("\n")[0]
        ):
            raise TextError(f"{path} was not generated and is left alone; nothing was written.")
    out.mkdir(parents=True, exist_ok=True)
    if not home and not (out / "__init__.py").exists():
        texts["__init__.py"] = f'"""Messages, {MARK}."""\n'
    for name, text in texts.items():
        (out / name).write_text(text, encoding="utf-8")
    for old in stale:
        old.unlink()
        if old.parent != out and not any(old.parent.iterdir()):
            old.parent.rmdir()
    return sorted(out / path for path in texts)


def _there(out: Path, package: str) -> list[Path]:
    """The files that an earlier run may have left for `package`; one of long ago made a folder of a large package."""
    single = out / f"{package}.py"
    return [*([single] if single.is_file() else []), *sorted((out / package).glob("*.py"))]
