"""What goes into the Android package: exactly the files that buildozer.spec selects, and requirements that keep their pins.

The files are compiled as the phone gets them (`-OO`: no asserts, no docstrings), and every module of that tree is imported in a process
that has no robot side, no simulator and no desktop library.
"""

from __future__ import annotations

import ast
import configparser
import fnmatch
import re
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

from scripts.android.failure import Failed, run

__all__ = [
    "Spec",
    "check_files",
    "check_imports",
    "check_options",
    "check_requirements",
    "compile_all",
    "import_all",
    "modules",
    "read_spec",
    "selected",
    "stage",
    "words",
]

Spec = configparser.SectionProxy
"""What buildozer.spec says of the app."""
SHIPPED = {"app", "widgets", "bridge", "main.py"}
DESKTOP = ("bridge/generate/", "bridge/definitions/")
"""The parts of them that generate the rest and are not needed on the phone."""
DESKTOP_ONLY = (
    "robotside",
    "sim",
    "tests",
    "bench",
    "examples",
    "pybullet",
    "scipy",
    "skimage",
    "moderngl",
    "PIL",
    "hama",
    "hibari",
    "miniaudio",
    "pocketsphinx",
    "vosk",
    "espeakng_loader",
)
"""What the phone does not have. Neither has it cryptography, but a desktop's spake2 cannot be imported without."""

OPTIONAL = {
    "PIL",
    "espeakng_loader",
    "hama",
    "hibari",
    "lz4",
    "miniaudio",
    "pocketsphinx",
    "vosk",
    "zeroconf",
    "zstandard",
}
"""Those of them that the handheld uses where they are installed, and runs without elsewhere."""

ROBOT_SIDE = {"cryptography"}
"""Of the robot alone: the handheld neither asks for them nor imports them."""

NO_RECIPE = {
    "orjson",
    "pybullet",
    "scipy",
    "scikit_image",
    "moderngl",
    "simplejpeg",
    "pocketsphinx",
    "lz4",
    "zstandard",
}
"""Compiled packages that python-for-android has no recipe for."""

FILES = (
    "icon.filename",
    "presplash.filename",
    "android.extra_manifest_xml",
    "android.extra_manifest_application_arguments",
)
"""Options that name a file."""

IMPORT_ALL = """
import importlib, os, sys
os.environ.update(KIVY_NO_ARGS="1", KIVY_NO_CONFIG="1", KIVY_NO_FILELOG="1", KIVY_NO_CONSOLELOG="1",
                  KIVY_LOG_MODE="PYTHON", SDL_VIDEODRIVER="offscreen", LIBGL_ALWAYS_SOFTWARE="1")
os.environ.pop("DISPLAY", None)
blocked = set(sys.argv[1].split(","))
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in blocked:
            raise ModuleNotFoundError(f"{name} is not on the phone", name=name)
sys.meta_path.insert(0, Missing())
sys.path.insert(0, os.getcwd())
for name in sys.argv[2:]:
    importlib.import_module(name)
sys.stdout.flush()
os._exit(0)
"""


def read_spec(path: Path) -> Spec:
    """The `[app]` section of a buildozer.spec."""
    parser = configparser.ConfigParser(interpolation=None)
    parser.read(path)
    if not parser.has_section("app"):
        raise Failed(f"{path.name} has no [app] section.")
    return parser["app"]


def words(spec: Spec, key: str) -> list[str]:
    """A comma separated value as a list; empty when the key is absent."""
    return [word.strip() for word in spec.get(key, "").split(",") if word.strip()]


def selected(root: Path, spec: Spec) -> Iterator[Path]:
    """The files that buildozer 1.6.0 would copy, relative to `root`, by its own rules."""
    extensions = set(words(spec, "source.include_exts"))
    folders = tuple(f"{name.strip('/').lower()}/" for name in words(spec, "source.exclude_dirs"))
    patterns = [pattern.lower() for pattern in words(spec, "source.exclude_patterns")]
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        lower = relative.as_posix().lower()
        hidden = any(part.startswith(".") for part in relative.parts)
        if hidden or not path.is_file() or lower.startswith(folders):
            continue
        if any(fnmatch.fnmatch(lower, pattern) for pattern in patterns):
            continue
        if path.suffix and path.suffix[1:] not in extensions:
            continue
        yield relative


def check_files(root: Path, spec: Spec) -> list[Path]:
    """Only the handheld's parts are in; each of them is."""
    files = list(selected(root, spec))
    strangers = [str(path) for path in files if path.parts[0] not in SHIPPED]
    if strangers:
        raise Failed(f"the package would carry {', '.join(strangers[:5])}, which is no part of the handheld.")
    ours = {path.relative_to(root) for name in SHIPPED for path in (root / name).rglob("*") if path.is_file()}
    left = [
        path
        for path in sorted(each.as_posix() for each in ours - set(files))
        if "__pycache__" not in path and not path.startswith(DESKTOP)
    ]
    if carried := [path for path in files if path.as_posix().startswith(DESKTOP)]:
        raise Failed(f"the package would carry {carried[0]}, which only a desktop needs.")
    if left:
        raise Failed(f"the package would lack {', '.join(left[:5])}, which the handheld's folders hold.")
    absent = SHIPPED - {path.parts[0] for path in files}
    if absent:
        raise Failed(f"the package would lack {', '.join(sorted(absent))}.")
    return files


def check_requirements(spec: Spec) -> list[str]:
    """Each requirement is spelled so that python-for-android keeps its pin."""
    found = words(spec, "requirements")
    for requirement in found:
        name, _, _version = requirement.partition("==")
        if re.search(r"[<>~!;\[ ]", name):
            raise Failed(f"requirement {requirement}: only NAME or NAME==VERSION is understood.")
        if name != name.lower() or "-" in name:
            raise Failed(
                f"requirement {requirement}: write it in lower case with underscores, else its pin is lost."
            )
        if name in NO_RECIPE:
            raise Failed(
                f"requirement {requirement} is compiled and python-for-android has no recipe for it."
            )
        if name in ROBOT_SIDE:
            raise Failed(f"requirement {requirement} is of the robot side; the handheld does without.")
    return found


def check_options(root: Path, spec: Spec) -> None:
    """The version is dotted integers, the XML snippets exist, and no option breaks the build."""
    text = (root / "pyproject.toml").read_text()
    version = re.search(spec["version.regex"], text)
    if not version or not re.fullmatch(r"\d+(\.\d+){1,2}", version.group(1)):
        raise Failed(
            f"version {version and version.group(1)}: Android needs two or three integers with dots."
        )
    if "android.features" in spec:
        raise Failed(
            "android.features breaks the build; say <uses-feature> in android_xml/manifest_extra.xml."
        )
    for key in FILES:
        named = spec[key].replace("%(source.dir)s", ".")
        if not (root / named).is_file():
            raise Failed(f"{key} names {named}, which is not there.")


def third_party(files: list[Path], root: Path) -> set[str]:
    """Top-level names that the shipped code imports and that neither it nor Python has."""
    found = set()
    for path in files:
        if path.suffix != ".py":
            continue
        for node in ast.walk(ast.parse((root / path).read_text())):
            if isinstance(node, ast.Import):
                found |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                found.add(node.module.split(".")[0])
    return found - sys.stdlib_module_names - SHIPPED - {"app", "widgets", "bridge"}


def check_imports(files: list[Path], root: Path, requirements: list[str]) -> None:
    """Everything imported is asked for in the spec, comes with Kivy, or is Android's own."""
    names = [name.partition("==")[0] for name in requirements]
    # a package may be spelled with an underscore where its own name has a dot
    asked = {re.split(mark, name)[0] for name in names for mark in (r"\.", r"[._]")}
    strangers = third_party(files, root) - asked - {"jnius", "android"} - OPTIONAL
    if strangers:
        raise Failed(f"the handheld imports {', '.join(sorted(strangers))}, which the spec does not ask for.")


def stage(files: list[Path], root: Path, to: Path) -> None:
    """Copy the files into a tree of their own."""
    for path in files:
        (to / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(root / path, to / path)


def modules(files: list[Path]) -> list[str]:
    """Dotted names of the staged Python files; a package's entry points are imported as any other module."""
    names = [".".join(path.with_suffix("").parts) for path in files if path.suffix == ".py"]
    return [name.removesuffix(".__init__") for name in names if name != "main"] + ["main"]


def compile_all(tree: Path) -> None:
    """As the phone gets them; Failed for what is no Python."""
    # -I keeps this checkout off the path
    run(sys.executable, "-OO", "-I", "-m", "compileall", "-q", ".", where=tree)


def import_all(tree: Path, files: list[Path]) -> int:
    """Imports every module of the tree, and says how many; Failed where one needs what the phone does not have."""
    names = modules(files)
    run(sys.executable, "-OO", "-I", "-c", IMPORT_ALL, ",".join(DESKTOP_ONLY), *names, where=tree)
    return len(names)
