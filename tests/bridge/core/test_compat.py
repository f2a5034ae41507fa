"""The named habits of other servers."""

from __future__ import annotations

import dataclasses

from bridge.core.compat import Compat


def test_as_it_comes_everything_is_as_todays_clients_lean_on():
    assert all(dataclasses.asdict(Compat()).values())


def test_strict_is_the_specification_in_everything():
    assert not any(dataclasses.asdict(Compat.strict()).values())
