#!/usr/bin/env bash
# Plays the stories of one robot, or of all, one after the other; ends with 1 when one of them did not hold.
set -euo pipefail
cd "$(dirname "$0")/.."
python=${PYTHON:-.venv/bin/python}
robot=${1:-patrol}
code=0

play() {
    "$python" -m examples.demo "$@" || { ended=$?; [ "$ended" -gt "$code" ] && code=$ended; true; }
}

if [ "$robot" = patrol ] || [ "$robot" = all ]; then
    play
    play --story errand
fi
if [ "$robot" = all ]; then
    for one in scout commander minnow aqua ardrone; do play --robot "$one"; done
elif [ "$robot" != patrol ]; then
    play --robot "$robot"
fi
exit "$code"
