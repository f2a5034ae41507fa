"""Runs every check of the Android package and prints a line for each; ends with 1 when one did not hold."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from scripts.android import bare_run, java_names, manifest, package, permissions, recipes, shaders
from scripts.android.failure import Failed, run

ROOT = Path(__file__).parents[2]
TOOLS = ROOT / ".venv/android/bin/python"
"""The Python that has buildozer and python-for-android; `scripts/setup.sh android` makes it."""
BARE = ROOT / ".venv/android-bare"
"""The environment that has the package's modules alone."""


def _package(folder: Path, spec: package.Spec, files: list[Path]) -> Iterator[str]:
    asked = package.check_requirements(spec)
    package.check_options(ROOT, spec)
    package.check_imports(files, ROOT, asked)
    size = sum((ROOT / path).stat().st_size for path in files)
    yield f"spec: {len(files)} files, {size / 1e6:.1f} MB, only main.py, app, widgets and bridge"
    yield f"requirements: {len(asked)}, each spelled as python-for-android wants it, none missing"
    package.stage(files, ROOT, folder / "tree")
    package.compile_all(folder / "tree")
    yield "compiled: every file, without asserts and docstrings (-OO)"
    count = package.import_all(folder / "tree", files)
    yield f"imported: {count} modules with neither robot side, simulator nor desktop libraries at hand"
    yield shaders.check_shaders(files, ROOT)


def _told_to_android(folder: Path, spec: package.Spec, files: list[Path]) -> Iterator[str]:
    asked = package.words(spec, "android.permissions")
    api, least = int(spec["android.api"]), int(spec["android.minapi"])
    tree = manifest.rendered(TOOLS, ROOT / "buildozer.spec", folder / "rendered")
    manifest.check_manifest(tree.manifest.read_text(), asked, api, least)
    manifest.check_gradle((tree.dist / "build.gradle").read_text(), api, least)
    made = manifest.packed(tree, folder)
    manifest.check_badging(run("aapt", "dump", "badging", str(made), where=folder), tree, asked)
    yield f"manifest: of python-for-android's templates, for Android {least} to {api}, read by aapt, no device shut out"
    stubs = java_names.stubs_folder()
    yield java_names.check_java_names(files, ROOT, stubs, tree.dist)
    yield permissions.check_permissions(asked, files, ROOT, stubs)
    permissions.check_queries((ROOT / spec["android.extra_manifest_xml"]).read_text(), files, ROOT)


def _built(folder: Path, _spec: package.Spec, _files: list[Path]) -> Iterator[str]:
    found = recipes.resolved(TOOLS, ROOT / "buildozer.spec")
    yield recipes.check_recipes(found)
    yield bare_run.check_runs(bare_run.environment(BARE, found), folder / "tree", folder)


PARTS: tuple[Callable[[Path, package.Spec, list[Path]], Iterator[str]], ...] = (
    _package,
    _told_to_android,
    _built,
)


def main() -> int:
    """All of them, in turn."""
    try:
        spec = package.read_spec(ROOT / "buildozer.spec")
        files = package.check_files(ROOT, spec)
        if not TOOLS.is_file():
            raise Failed("python-for-android is not installed; run make android-check, which installs it.")
        with tempfile.TemporaryDirectory() as name:
            for part in PARTS:
                for line in part(Path(name), spec, files):
                    print(line, flush=True)
    except Failed as failure:
        print(f"android-check: {failure}")
        return 1
    print("android-check: all held; no APK was built, that needs Google's toolchain")
    return 0


if __name__ == "__main__":
    sys.exit(main())
