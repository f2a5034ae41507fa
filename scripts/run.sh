#!/usr/bin/env bash
# Opens the app beside a simulated robot and ends the robot with it. Without a display it runs the demo instead.
set -euo pipefail
cd "$(dirname "$0")/.."
python=${PYTHON:-.venv/bin/python}

if [ -z "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    echo "run: this machine has no display; running the demo, whose pictures go to out/demo."
    exec "$python" -m examples.demo --out out/demo
fi

# Prints the port if nothing listens there, else 0, which takes any that is free.
free() { if (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; then echo 0; else echo "$1"; fi; }

log=$(mktemp)
"$python" -m robotside serve --robot "sim:${ROBOT:-patrol}" --world "${WORLD:-parking_lot}" \
    --port "$(free 9090)" --http-port "$(free 8080)" >"$log" 2>&1 &
robot=$!
# SIGTERM lets the robot side bring the robot to rest and end with 0
trap 'kill -TERM $robot 2>/dev/null || true; wait $robot || true; rm -f "$log"' EXIT
until grep '^robotside: ready' "$log"; do
    if ! kill -0 $robot 2>/dev/null; then
        cat "$log" >&2
        wait $robot
        exit
    fi
    sleep 0.1
done
"$python" main.py
