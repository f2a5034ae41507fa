"""Sticks, levers and circles that a finger or a gamepad pushes and that spring back."""
