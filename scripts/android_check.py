"""Checks of the Android package that need no toolchain; builds no package.

It stages exactly the files that buildozer.spec selects, compiles them as the phone gets them (`-OO`: no asserts,
no docstrings), imports every module of that tree in a process that has no robot side, no simulator and no desktop
library, and checks the spec for the known traps of python-for-android.
"""

from __future__ import annotations

import ast
import configparser
import fnmatch
import importlib.util
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
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


class Failed(Exception):
    """A check did not hold; its text is the sentence to print."""


def read_spec(path: Path) -> configparser.SectionProxy:
    """The `[app]` section of a buildozer.spec."""
    parser = configparser.ConfigParser(interpolation=None)
    parser.read(path)
    if not parser.has_section("app"):
        raise Failed(f"{path.name} has no [app] section.")
    return parser["app"]


def words(spec: configparser.SectionProxy, key: str) -> list[str]:
    """A comma separated value as a list; empty when the key is absent."""
    return [word.strip() for word in spec.get(key, "").split(",") if word.strip()]


def selected(root: Path, spec: configparser.SectionProxy) -> Iterator[Path]:
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


def check_files(root: Path, spec: configparser.SectionProxy) -> list[Path]:
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


def check_requirements(spec: configparser.SectionProxy) -> list[str]:
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


def check_manifest(root: Path, spec: configparser.SectionProxy) -> None:
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


def check_voice(root: Path, spec: configparser.SectionProxy) -> None:
    """What hears and talks on the phone is asked for: the microphone, and to see the services behind it (Android 11)."""
    if "android.permission.RECORD_AUDIO" not in words(spec, "android.permissions"):
        raise Failed(
            "android.permissions lacks android.permission.RECORD_AUDIO: no spoken command would be heard."
        )
    manifest = (root / spec["android.extra_manifest_xml"]).read_text()
    for service in ("android.speech.RecognitionService", "android.intent.action.TTS_SERVICE"):
        if service not in manifest:
            raise Failed(
                f"the manifest does not ask for {service} in <queries>: Android 11 and later hide it."
            )


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
    asked = {name.partition("==")[0].split(".")[0] for name in requirements}
    strangers = third_party(files, root) - asked - {"jnius", "android"} - OPTIONAL
    if strangers:
        raise Failed(f"the handheld imports {', '.join(sorted(strangers))}, which the spec does not ask for.")


def stage(files: list[Path], root: Path, to: Path) -> None:
    """Copy the files into a tree of their own."""
    for path in files:
        (to / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(root / path, to / path)


def run(*command: str, where: Path) -> None:
    """Run a command in the staged tree; Failed with its last lines when it fails."""
    # -I keeps this checkout off the path; the staged tree is put on it by hand
    done = subprocess.run(
        [sys.executable, "-OO", "-I", *command],
        cwd=where,
        capture_output=True,
        text=True,
        check=False,
        timeout=180,
    )
    if done.returncode:
        raise Failed("\n".join((done.stdout + done.stderr).strip().splitlines()[-8:]))


def modules(files: list[Path]) -> list[str]:
    """Dotted names of the staged Python files; a package's entry points are imported as any other module."""
    names = [".".join(path.with_suffix("").parts) for path in files if path.suffix == ".py"]
    return [name.removesuffix(".__init__") for name in names if name != "main"] + ["main"]


def shaders(files: list[Path], root: Path) -> Iterator[tuple[str, str, str]]:
    """(where, `frag` or `vert`, GLSL text) of each shader that stands in the code as a string."""
    for path in files:
        if path.suffix != ".py":
            continue
        for node in ast.walk(ast.parse((root / path).read_text())):
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and "void main" in node.value:
                kind = "vert" if "gl_Position" in node.value else "frag"
                yield f"{path}:{node.lineno}", kind, node.value


def glsl_es(kind: str, text: str) -> str:
    """The text with Kivy's header put in, as the phone's compiler gets it."""
    found = importlib.util.find_spec("kivy")  # importing it would print and write logs
    if found is None or found.origin is None:
        raise Failed("Kivy, whose header the shaders need, is not installed.")
    header = Path(found.origin).parent / "data" / "glsl" / f"header.{kind[0]}s"
    body = text.replace("$HEADER$", header.read_text())
    return "#version 100\n" + body


def check_shaders(files: list[Path], root: Path) -> str:
    """Compile the shaders where the reference compiler is installed; returns what was done."""
    found = list(shaders(files, root))
    tool = shutil.which("glslangValidator")
    if not tool:
        return f"shaders: {len(found)} NOT checked, glslangValidator is not installed (Debian: glslang-tools)"
    for where, kind, text in found:
        command = [tool, "--stdin", "-S", kind]
        done = subprocess.run(command, input=glsl_es(kind, text), capture_output=True, text=True, check=False)
        if done.returncode:
            raise Failed(f"the shader at {where} is not GLSL ES 1.00: {done.stdout.strip()}")
    return f"shaders: {len(found)} compile as GLSL ES 1.00"


def main() -> int:
    """Run every check and print a line for each; 1 when one did not hold."""
    try:
        spec = read_spec(ROOT / "buildozer.spec")
        files = check_files(ROOT, spec)
        requirements = check_requirements(spec)
        check_manifest(ROOT, spec)
        check_voice(ROOT, spec)
        check_imports(files, ROOT, requirements)
        size = sum((ROOT / path).stat().st_size for path in files)
        print(f"spec: {len(files)} files, {size / 1e6:.1f} MB, only main.py, app, widgets and bridge")
        print(f"requirements: {len(requirements)}, each spelled as python-for-android wants it, none missing")
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder)
            stage(files, ROOT, tree)
            run("-m", "compileall", "-q", ".", where=tree)
            print("compiled: every file, without asserts and docstrings (-OO)")
            names = modules(files)
            run("-c", IMPORT_ALL, ",".join(DESKTOP_ONLY), *names, where=tree)
            print(
                f"imported: {len(names)} modules with neither robot side, simulator nor desktop libraries at hand"
            )
            print(check_shaders(files, ROOT))
    except Failed as failure:
        print(f"android-check: {failure}")
        return 1
    print("android-check: all held; no APK was built, that needs Google's toolchain")
    return 0


if __name__ == "__main__":
    sys.exit(main())
