"""Bringing a robot up: what a user chooses, where the choice is kept, and what the user is told of it."""
