"""The first look round: five cards that point at the real things, left at any time."""
