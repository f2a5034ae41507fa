#!/usr/bin/env bash
# Opens the app beside one or several simulated robots and ends them with it. Without a display it runs the demo instead.
set -euo pipefail
cd "$(dirname "$0")/.."
python=${PYTHON:-.venv/bin/python}
robots=${ROBOT:-patrol}

if [ -z "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    echo "run: this machine has no display; running the demo, whose pictures go to out/."
    exec "$python" -m examples.demo --robot "${robots%%[,+]*}" --world "${WORLD:-}"
fi

commas=${robots//[!,]/}
count=$((${#commas} + 1))

# Prints the port if nothing listens there and on those that follow it, one for each robot, else 0, which takes any that are free.
free() {
    for ((port = $1; port < $1 + count; port++)); do
        if (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; then echo 0; return; fi
    done
    echo "$1"
}

log=$(mktemp)
"$python" -m robotside serve --robot "sim:$robots" --world "${WORLD:-}" \
    --port "$(free 9090)" --http-port "$(free 8080)" --pair >"$log" 2>&1 &
robot=$!
# SIGTERM lets the robot side bring the robots to rest and end with 0
trap 'kill -TERM $robot 2>/dev/null || true; wait $robot || true; rm -f "$log"' EXIT
until [ "$(grep -c '^robotside: ready' "$log")" -ge "$count" ]; do
    if ! kill -0 $robot 2>/dev/null; then
        cat "$log" >&2
        wait $robot
        exit
    fi
    sleep 0.1
done
grep '^robotside: ready' "$log"
# each robot says the link by which this handheld pairs with it; one that says none is reached without a key
pairs=()
while read -r link; do pairs+=(--pair "$link"); done < <(sed -n 's/^robotside: pair //p' "$log")
"$python" main.py ${pairs[@]+"${pairs[@]}"}
