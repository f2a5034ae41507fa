"""Renders what python-for-android tells Android of the app, by its own templates: `render.py SPEC FOLDER`.

It runs in a Python of its own, which has buildozer and python-for-android. In FOLDER/dist stand then AndroidManifest.xml, build.gradle,
res/ and assets/ as a build would have them; the last line printed is the package's name. buildozer writes the command line that
python-for-android gets, and is stopped before it runs it.
"""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import pythonforandroid
from buildozer import Buildozer
from pythonforandroid.bootstrap import copy_files

TAKE_A_VALUE = frozenset(
    {"--bootstrap", "--dist_name", "--arch", "--ndk-api", "--android_api", "--local-recipes"}
)
"""Options that the tool takes for itself before the templates' program gets the rest."""
ALONE = frozenset({"--copy-libs"})
TOOLS = "36.0.0"
"""Any version of the build tools: only the name of the folder is read."""


class Written(Exception):
    """What buildozer would have run."""


def prepared(spec: Path, folder: Path) -> Any:
    """buildozer's own state right before it hands over to python-for-android."""
    build = Buildozer(str(spec))
    if not build.config.has_section("buildozer"):
        build.config.add_section("buildozer")
    build.config.set("buildozer", "build_dir", str(folder / "buildozer"))
    build.user_bin_dir = str(folder / "bin")
    build.logger.set_level(0)
    build.set_target("android")
    build.build_mode = build.target.build_mode = "debug"
    build._copy_application_sources()
    build._add_sitecustomize()
    return build.target


def lay_out(target: Any, folder: Path) -> Path:
    """The tree of templates, in the order in which the tool lays one over the other."""
    dist = folder / "dist"
    target.get_dist_dir = lambda _: str(dist)
    for part in ("common", "_sdl_common", target._p4a_bootstrap):
        copy_files(str(Path(pythonforandroid.__file__).parent / "bootstraps" / part / "build"), str(dist))
    (folder / "sdk" / "build-tools" / TOOLS).mkdir(parents=True)
    (dist / "project.properties").write_text(f"target=android-{target.android_api}")
    (dist / "local.properties").write_text(f"sdk.dir={folder / 'sdk'}")
    archs = list(target._archs)
    facts = {"dist_name": "check", "bootstrap": target._p4a_bootstrap, "archs": archs, "recipes": [],
             "ndk_api": int(target.android_minapi), "hostpython": sys.executable, "python_version": "3.14",
             "use_setup_py": False}  # fmt: skip
    (dist / "dist_info.json").write_text(json.dumps(facts))
    for arch in archs:
        (dist / "libs" / arch).mkdir(parents=True, exist_ok=True)
        (dist / f"_python_bundle__{arch}").mkdir()
    return dist


def command_line(target: Any) -> list[str]:
    """The arguments that buildozer writes for python-for-android."""
    written: list[str] = []

    def catch(command: list[Any], **_: Any) -> None:
        written.extend(str(part) for part in command)
        raise Written

    target._p4a = catch
    with contextlib.suppress(Written):
        target.build_package()
    return written


def for_templates(arguments: list[str]) -> list[str]:
    """Those of them that reach the program of the templates, `build.py`."""
    rest, at = [], 1
    while at < len(arguments):
        word = arguments[at]
        if word in TAKE_A_VALUE:
            at += 2
            continue
        if word not in ALONE:
            rest.append(word.replace("--add-", "--") if word in {"--add-asset", "--add-resource"} else word)
        at += 1
    return rest


def main() -> None:
    """Render, and print the name of the package."""
    spec, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    os.environ["HOME"] = tempfile.mkdtemp()
    os.chdir(spec.parent)
    target = prepared(spec, folder)
    dist = lay_out(target, folder)
    command = [sys.executable, "build.py", *for_templates(command_line(target))]
    done = subprocess.run(command, cwd=dist, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit((done.stdout + done.stderr)[-2000:])
    sys.stdout.write(f"\n{target._get_package()}\n")


if __name__ == "__main__":
    main()
