"""What a test needs and a machine may lack.

Where somebody develops, such a test is skipped, and the closing line of `make test` counts it by the name of what is lacking.
In CI, where `MAY_LACK` or `CI` is set, it fails, so that nothing goes unproven there; `MAY_LACK` names, with spaces
between, what may lack even there.
"""

from __future__ import annotations

import importlib
import os
import warnings
from types import ModuleType
from typing import NoReturn

import pytest

__all__ = ["lacking", "package"]


def lacking(what: str, why: str = "") -> NoReturn:
    """End the test, or the collection of its module, that needs `what`, one word."""
    said = f"This machine lacks {what}: {why}." if why else f"This machine lacks {what}."
    allowed = os.environ.get("MAY_LACK")
    strict = allowed is not None or bool(os.environ.get("CI"))
    if strict and what not in (allowed or "").split():
        pytest.fail(said, pytrace=False)
    pytest.skip(said, allow_module_level=True)


def package(name: str) -> ModuleType:
    """An installed package; the test ends where it is not installed, and fails where something that it needs is not."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what a package warns of as it is imported is its own matter
            return importlib.import_module(name)
    except ModuleNotFoundError as missing:
        if missing.name != name:
            raise
    lacking(name)
