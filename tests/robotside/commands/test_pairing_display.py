"""What the terminal shows to pair."""

from __future__ import annotations

from robotside.commands.pairing_display import shown


def test_it_names_the_robot_the_code_the_link_and_the_time() -> None:
    text = shown("Patrol-1", "pilothouse://x", "123456", 591.0)
    for part in ("Patrol-1", "123 456", "\npilothouse://x\n", "10 minutes"):
        assert part in text
