#!/usr/bin/env bash
# Runs the rings of tests, those that draw in processes of their own, and closes with one line that sums them up.
#   scripts/test.sh [fast|slow] fast: the pure logic, in a minute; slow: what the others leave out, `pytest.mark.slow`
# Where REPORTS names a folder, the reports are left in it, so that who set it sums several runs up.
set -uo pipefail
cd "$(dirname "$0")/.."
python=${PYTHON:-.venv/bin/python}
if [ -n "${REPORTS:-}" ]; then
    reports=$REPORTS/${1:-daily}
    mkdir -p "$reports"
    unset REPORTS # a test that runs this script leaves nothing there
else
    reports=$(mktemp -d)
    trap 'rm -rf "$reports"' EXIT
fi
# else each process compiles all that it imports anew, and tests start many
unset PYTHONDONTWRITEBYTECODE
status=0

ring() {
    local name=$1 begun=$SECONDS
    shift
    echo "== $name"
    "$python" -m pytest -q --durations=10 --durations-min=0.5 --junitxml="$reports/$name.xml" "$@"
    local code=$?
    echo "== $name took $((SECONDS - begun)) s"
    if [ $code -ne 0 ]; then
        status=1
        [ -f "$reports/$name.xml" ] || echo "$name" >>"$reports/broken"
    fi
}

# What computes and hardly waits, draws or simulates, chosen by what it costs: protocol, messages, layouts, inputs, the robot's
# control, limits, motion, planning and tasks, the physics, and what the repository promises of itself.
pure=(
    tests/bridge/{codec,core,discovery,generate,protocol,trust}
    tests/app/{core,intents,layout,missions} tests/app/inputs/switch_access/scan tests/widgets/core
    tests/robotside/{autonomy,control,core,kinds,limits,localisation,mapping,motion,navigation,perception,tasks}
    tests/sim/{core,dynamics}
    tests/test_{architecture,looped,lacking,mirror,project,sentences}.py
)
# several minutes of virtual time
costly=(--ignore=tests/robotside/tasks/test_agenda.py)

present() { compgen -G "$1" >/dev/null; }

# files with tests that the daily rings leave out; others are not even imported for the slow one
slow_files() { grep -rlE --include='test_*.py' 'pytest\.mark\.slow\b' "$@"; }

if [ "${1:-}" = fast ]; then
    ring fast -n 2 --dist worksteal -m 'not slow' "${costly[@]}" "${pure[@]}"
elif [ "${1:-}" = slow ]; then
    mapfile -t undrawn < <(slow_files --exclude-dir={pixels,e2e} tests)
    mapfile -t drawn < <(slow_files tests/{pixels,e2e})
    ring slow -n 2 --dist worksteal -m slow "${undrawn[@]}"
    [ ${#drawn[@]} -eq 0 ] || ring slow-drawn -n 2 --dist loadfile -m slow "${drawn[@]}"
else
    ring logic -n 2 --dist worksteal -m 'not slow'
    present 'tests/pixels/test_*.py' && ring pixels -n 2 -m 'not slow' tests/pixels
    present 'tests/e2e/test_*.py' && ring e2e -n 2 --dist loadfile -m 'not slow' tests/e2e
fi
"$python" scripts/sum_up.py "$reports"
exit $status
