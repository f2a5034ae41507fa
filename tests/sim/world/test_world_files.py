"""World files that cannot be used."""

from __future__ import annotations

from pathlib import Path

import pytest

from sim.world.world_files import WorldError, load


def test_a_file_that_is_no_text_is_told_with_the_line(tmp_path: Path) -> None:
    (tmp_path / "latin.toml").write_bytes('name = "x"\n# Stra\u00dfe'.encode("latin-1"))
    with pytest.raises(WorldError, match=r"latin\.toml, line 2: is no UTF-8 text\."):
        load(tmp_path / "latin.toml")
