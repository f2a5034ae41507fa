"""Prints as JSON what python-for-android makes of a spec's requirements: `resolve.py SPEC`.

It runs in a Python of its own, which has buildozer and python-for-android, and reads the graph by their own code. The wheels that pip
would take are asked of the package index.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from buildozer import Buildozer
from packaging.requirements import InvalidRequirement, Requirement
from pythonforandroid.bootstrap import Bootstrap
from pythonforandroid.build import Context
from pythonforandroid.graph import get_recipe_order_and_bootstrap
from pythonforandroid.recipe import PyProjectRecipe, Recipe

HOST = ("manylinux_2_28_x86_64", "manylinux_2_17_x86_64", "manylinux2014_x86_64", "linux_x86_64")
"""Wheels that the machine of a build takes."""


def pinned(requirements: list[str]) -> list[str]:
    """Names alone; the pins go where python-for-android looks for them."""
    names = []
    for requirement in requirements:
        name, _, version = requirement.partition("==")
        if version:
            os.environ[f"VERSION_{name}"] = version
        names.append(name)
    return names


def context(config: Any) -> Context:
    """A build's context, without SDK and NDK."""
    made = Context()
    made.local_recipes = config.getdefault("app", "p4a.local_recipes", "") or None
    made.setup_dirs(tempfile.mkdtemp())
    made.ndk_api = int(config.getdefault("app", "android.ndk_api", "24"))
    made.set_archs(config.getlist("app", "android.archs", ["arm64-v8a"]))
    return made


def installed(module: str, version: str, *options: str) -> str:
    """The file that pip takes for a module; empty where it finds none."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        command = [
            sys.executable, "-m", "pip", "install", "--dry-run", "--ignore-installed", "-q", "--no-deps",
            "--disable-pip-version-check", "--report", str(report), "--target", f"{folder}/site", *options,
        ]  # fmt: skip
        named = f"{module}=={version}" if version else module
        done = subprocess.run([*command, named], check=False, capture_output=True)
        if done.returncode:
            return ""
        (one,) = json.loads(report.read_text())["install"]
        return str(one["download_info"]["url"].rsplit("/", 1)[-1])


def module_facts(name: str, python: str, tags: list[str]) -> dict[str, str]:
    """Which file a phone could take, and which one pip takes on the machine of the build."""
    version = os.environ.get(f"VERSION_{name}", "")
    wheels = ["--only-binary=:all:", "--python-version", python]
    phone = installed(name, version, *wheels, *(f"--platform={tag}" for tag in tags))
    host = installed(name, version, *wheels, *(f"--platform={tag}" for tag in HOST))
    # pip builds on the host what has no wheel; --no-binary shows the source that it would take
    source = "" if phone or host else installed(name, version, "--no-binary=:all:")
    return {"name": name, "pin": version, "phone": phone, "host": host, "source": source}


def wanted(module: str, python: str) -> bool:
    """A recipe's dependency may be of another Python: its marker says so."""
    try:
        marker = Requirement(module).marker
    except InvalidRequirement:
        return True
    return marker is None or marker.evaluate({"python_version": ".".join(python.split(".")[:2])})


def recipe_facts(name: str, at: Context) -> dict[str, Any]:
    """What a recipe builds, and whether the spec's pin is another version than its own."""
    recipe = Recipe.get_recipe(name, at)
    return {
        "name": name,
        "version": str(recipe.version or ""),
        "own": str(recipe._version or ""),
        "patches": len(recipe.patches),
    }


def main() -> None:
    """Resolve, and print."""
    spec = Path(sys.argv[1]).resolve()
    os.environ["HOME"] = tempfile.mkdtemp()  # both write into it
    os.chdir(spec.parent)
    build = Buildozer(str(spec))
    build.logger.set_level(0)
    names = pinned([one for one in build.config.getlist("app", "requirements", []) if one])
    at = context(build.config)
    start = Bootstrap.get_bootstrap(build.config.getdefault("app", "p4a.bootstrap", "sdl2"), at)
    recipes, modules, bootstrap = get_recipe_order_and_bootstrap(at, names, start)
    at.recipe_build_order = recipes
    python = str(Recipe.get_recipe("python3", at).version)
    tags = PyProjectRecipe.get_wheel_platform_tags(at.archs[0].arch, at)
    answer = {
        "bootstrap": bootstrap.name,
        "python": python,
        "recipes": [recipe_facts(name, at) for name in recipes],
        "modules": [module_facts(name, python, tags) for name in sorted(modules) if wanted(name, python)],
    }
    sys.stdout.write("\n" + json.dumps(answer) + "\n")


if __name__ == "__main__":
    main()
