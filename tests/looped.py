"""Many cases in one test, for those that are quick: a case of its own costs pytest several milliseconds in every process."""

from __future__ import annotations

import functools
import inspect
import traceback
from collections.abc import Callable, Iterable
from typing import Any

import pytest

__all__ = ["looped"]


def looped(
    names: str | tuple[str, ...], cases: Iterable[Any]
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Call the test with each of `cases` for its argument `names`, and fail once with all that failed.

    Like `pytest.mark.parametrize`, several names take a tuple from each case. Fixtures of the test are those of all cases
    together, so it fits where a case leaves nothing behind for the next. A list without cases fails.
    """
    kept = list(cases)
    keys = (names,) if isinstance(names, str) else names

    def wrap(test: Callable[..., None]) -> Callable[..., None]:
        if inspect.iscoroutinefunction(test):
            raise TypeError(f"{test.__name__} is a coroutine, which has to be awaited.")

        def run(**fixtures: Any) -> None:
            skips: list[pytest.skip.Exception] = []
            faults = [said for case in kept if (said := _fault(test, keys, case, fixtures, skips))]
            assert kept, "There is no case."
            if faults:
                pytest.fail(
                    f"{len(faults)} of {len(kept)} cases failed:\n" + "\n".join(faults), pytrace=False
                )
            if skips:
                raise skips[0]

        # not `__wrapped__`, by which pytest and Hypothesis would find the test with its arguments
        functools.update_wrapper(run, test, updated=())
        del run.__wrapped__  # type: ignore[attr-defined]
        wanted = inspect.signature(test)
        left = [each for name, each in wanted.parameters.items() if name not in keys]
        run.__signature__ = wanted.replace(parameters=left)  # type: ignore[attr-defined]
        return run

    return wrap


def _fault(
    test: Callable[..., None],
    keys: tuple[str, ...],
    case: Any,
    fixtures: dict[str, Any],
    skips: list[pytest.skip.Exception],
) -> str:
    """What the case says against itself, by its name; empty when it holds, or when it goes to the `skips`."""
    values = (case,) if len(keys) == 1 else tuple(case)
    try:
        test(**dict(zip(keys, values, strict=True)), **fixtures)
    except pytest.skip.Exception as skip:
        skips.append(skip)
    except (Exception, pytest.fail.Exception) as fault:  # noqa: BLE001 - every kind of failure is told
        place = traceback.extract_tb(fault.__traceback__)[-1]
        told = "".join(traceback.format_exception_only(fault)).strip()
        named = ", ".join(f"{key}={value!r:.120}" for key, value in zip(keys, values, strict=True))
        return f"--- {named}\n{place.filename}:{place.lineno}: {told}"
    return ""
