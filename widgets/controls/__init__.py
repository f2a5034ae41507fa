"""What a finger drives and commands with."""
