"""A program that waits for the next test ends when it is told to, whatever was forked in between."""

from __future__ import annotations

import os

import pytest

from tests.apart import Child
from tests.clients.peers import BOTH, Programs


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
@BOTH
def test_a_program_ends_with_its_input_while_a_process_lives_that_was_forked_before(library: str) -> None:
    programs = Programs()
    process = programs.take(library, "asyncio")
    programs.give_back(process)
    child = Child(lambda pipe: pipe.recv())
    try:
        programs.close()
    finally:
        child.end()
    assert process.returncode == 0, "it ended by itself and was not killed"
