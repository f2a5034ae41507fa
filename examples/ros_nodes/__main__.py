"""`python -m examples.ros_nodes`: the nodes on one connection, until Ctrl+C."""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import sys
from collections.abc import Sequence

from bridge.client.client import BridgeClient, LinkState, Phase
from examples.ros_nodes.nodes import bring_up


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit code."""
    parser = argparse.ArgumentParser(
        "python -m examples.ros_nodes", description="A few ROS nodes for a robot."
    )
    parser.add_argument(
        "--connect", default="ws://127.0.0.1:9090", metavar="URL", help="the rosbridge server"
    )
    options = parser.parse_args(arguments)
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(_serve(options.connect))
    return 0


async def _serve(url: str) -> None:
    client = BridgeClient(url, on_state=_tell)
    nodes = bring_up(client)
    try:
        await client.run()
    finally:
        await nodes.close()
        await client.close()


def _tell(state: LinkState) -> None:
    if state.phase in (Phase.CONNECTED, Phase.WAITING):
        print(state.sentence, flush=True)


if __name__ == "__main__":
    sys.exit(main())
