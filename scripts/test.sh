#!/usr/bin/env bash
# Runs the rings of tests, those that draw in processes of their own, and closes with one line that sums them up.
#   scripts/test.sh [fast|slow] fast: the pure logic, in a minute; slow: the ring of long explorations alone
set -uo pipefail
cd "$(dirname "$0")/.."
python=${PYTHON:-.venv/bin/python}
reports=$(mktemp -d)
trap 'rm -rf "$reports"' EXIT
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
# those among them that take several seconds each
costly=(
    --ignore-glob='*_in_sim.py' --ignore-glob='*_stateful.py' --ignore=tests/robotside/limits/test_fence_guard.py
    --ignore=tests/robotside/navigation/test_ackermann_controller.py --ignore=tests/robotside/tasks/test_agenda.py
    --ignore=tests/robotside/tasks/test_interrupted_task.py
)

present() { compgen -G "$1" >/dev/null; }

if [ "${1:-}" = fast ]; then
    ring fast -n 2 --dist worksteal "${costly[@]}" "${pure[@]}"
elif [ "${1:-}" = slow ]; then
    ring slow -n 2 --dist worksteal tests/slow
else
    ring logic -n 2 --dist loadscope --ignore=tests/slow
    present 'tests/pixels/test_*.py' && ring pixels -n 2 tests/pixels
    present 'tests/e2e/test_*.py' && ring e2e -n 2 --dist loadfile tests/e2e
    present 'tests/slow/test_*.py' && ring slow -n 2 --dist worksteal tests/slow
fi
"$python" scripts/sum_up.py "$reports"
exit $status
