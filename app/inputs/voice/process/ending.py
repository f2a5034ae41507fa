"""Processes and threads of voice are ended beside the glass: one that hangs holds up no finger, no key and no STOP.

end_aside(process, reader)      # returns at once
wait_for_ends()                 # when the app ends: nothing is left
"""

from __future__ import annotations

import contextlib
import subprocess
import threading
import time

__all__ = ["END_TIMEOUT", "end", "end_aside", "wait_for_ends"]

END_TIMEOUT = 2.0
"""A process that does not end by itself in so long is ended, and a thread that waits for one is left after twice as long [s]."""
_ending: set[threading.Thread] = set()


def end(process: subprocess.Popen[str]) -> None:
    """It ends with its standard input, and by force if it hangs; takes up to `END_TIMEOUT`."""
    if process.stdin is not None:
        with contextlib.suppress(OSError):
            process.stdin.close()
    try:
        process.wait(END_TIMEOUT)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    if process.stdout is not None:
        process.stdout.close()


def end_aside(process: subprocess.Popen[str] | None, reader: threading.Thread | None) -> None:
    """End the process and the thread that reads from it, in a thread of its own."""
    if process is None and reader is None:
        return
    job = threading.Thread(target=_end_both, args=(process, reader), name="voice ends", daemon=True)
    _ending.add(job)
    job.start()


def _end_both(process: subprocess.Popen[str] | None, reader: threading.Thread | None) -> None:
    try:
        if process is not None:
            end(process)
        if reader is not None:
            reader.join(2 * END_TIMEOUT)
    finally:
        _ending.discard(threading.current_thread())


def wait_for_ends(timeout: float = 2 * END_TIMEOUT) -> None:
    """Until all that was ended aside is gone, at most so long [s]."""
    until = time.monotonic() + timeout
    for job in tuple(_ending):
        job.join(max(0.0, until - time.monotonic()))
