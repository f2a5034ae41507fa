"""`python -m bridge.generate`: typed classes from ROS text."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

EXAMPLES = """\
examples:
  python -m bridge.generate boat_msgs/msg/Boat.msg --out generated
      makes generated/boat_msgs.py with the class Boat; what it needs is looked for beside it
  python -m bridge.generate boat_msgs --out generated
      all of a package: every .msg, .srv and .action below the folder
  python -m bridge.generate Boat.msg --package boat_msgs --out generated
      a file that lies in no PACKAGE/msg folder

A service becomes two classes (XRequest, XResponse), an action three (XGoal, XResult, XFeedback). Give all files of a
package at once: its module is written anew. Exit codes: 0 done, 2 wrong text or options, 1 a fault.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit code."""
    parser = argparse.ArgumentParser(
        "python -m bridge.generate",
        description="Make typed Python classes of ROS .msg, .srv and .action text.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="ROS text, or a folder of it")
    parser.add_argument(
        "--out", type=Path, required=True, metavar="DIR", help="where the modules are written"
    )
    parser.add_argument("--package", metavar="NAME", help="the ROS package, where the folders do not name it")
    options = parser.parse_args(arguments)
    try:
        from bridge.generate.model import TextError
        from bridge.generate.writing import generate
    except ImportError as error:
        package = (error.name or "a package").partition(".")[0]
        print(f"{package} is not installed; it comes with the dev extra: make setup-test.", file=sys.stderr)
        return 2
    try:
        for path in generate(options.files, options.out, options.package):
            print(path)
    except (TextError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
