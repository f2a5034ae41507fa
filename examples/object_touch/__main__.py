"""Serves a page with the camera's stream, a button for each of three poses of the arm, and STOP.

python -m robotside serve --world examples/object_touch/table.toml --payloads arm --allow-origin http://localhost:8000
python -m examples.object_touch

then open http://localhost:8000/. The page is plain HTML: any file server does as well.
"""

from __future__ import annotations

import argparse
import contextlib
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import urlencode

__all__ = ["page_server", "page_url"]

SITE = Path(__file__).parent / "site"
WORLD = Path(__file__).parent / "table.toml"
"""A room with something to touch."""


class _Pages(SimpleHTTPRequestHandler):
    """Says nothing of what is asked for."""

    def log_message(self, format: str, *args: object) -> None:
        """Not of the example's concern."""


def page_server(port: int) -> ThreadingHTTPServer:
    """Serves the page on this machine, on a free port for 0, once `serve_forever` runs."""
    return ThreadingHTTPServer(("127.0.0.1", port), partial(_Pages, directory=str(SITE)))


def page_url(port: int, robot: str = "", web: str = "") -> str:
    """Where the page is; it looks for the robot's socket and web site at their usual ports unless they are given."""
    given = {key: value for key, value in (("robot", robot), ("web", web)) if value}
    return f"http://localhost:{port}/" + (f"?{urlencode(given)}" if given else "")


def main() -> None:
    """Serve until Ctrl+C."""
    parser = argparse.ArgumentParser(
        prog="python -m examples.object_touch",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--port", type=int, default=8000, help="of the page")
    parser.add_argument(
        "--robot", default="", metavar="URL", help="the robot's socket, as ws://127.0.0.1:9090"
    )
    parser.add_argument("--web", default="", metavar="URL", help="its web site, as http://127.0.0.1:8080")
    chosen = parser.parse_args()
    with page_server(chosen.port) as server:
        print(f"The page is at {page_url(server.server_port, chosen.robot, chosen.web)}", flush=True)
        print(f"The robot lets it in with --allow-origin http://localhost:{server.server_port}", flush=True)
        with contextlib.suppress(KeyboardInterrupt):
            server.serve_forever()


if __name__ == "__main__":
    main()
