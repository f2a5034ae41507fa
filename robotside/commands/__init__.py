"""The commands of `python -m robotside` beside `serve`: each works on a state directory, also beside a running robot.

One module for each, with `add(subparsers)`, which adds its options and sets `run` as their default, and
`run(options) -> int`, which does it and returns the exit code. `robotside.options.COMMANDS` lists them.
"""
