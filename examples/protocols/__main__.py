"""Calls a service of a robot by the protocol that a URL names, and prints the answer.

python -m examples.protocols ws://127.0.0.1:9090 /arm/move '{"order": {"pose": "home"}}'
python -m examples.protocols websocket=ws://127.0.0.1:9190 /task/go_home
python -m examples.protocols mqtt://127.0.0.1:1883/pilothouse/Patrol-1 /stop
"""

from __future__ import annotations

import argparse
import json
import sys

from examples.protocols.ways import FAULTS, PROTOCOLS, sentence, way_to


def main() -> int:
    """One call; the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m examples.protocols",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("url", help=f"of the robot or its broker, after one of {', '.join(PROTOCOLS)} and =")
    parser.add_argument("service", help="as /arm/move")
    parser.add_argument("request", nargs="?", default="{}", type=json.loads, help="its fields as JSON")
    chosen = parser.parse_args()
    try:
        with way_to(chosen.url) as way:
            print(json.dumps(way.call(chosen.service, chosen.request), indent=2))
    except FAULTS as problem:
        print(sentence(chosen.url, problem), file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
