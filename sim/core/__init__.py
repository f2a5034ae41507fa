"""Shapes, noise, constants, parameter tables, sensor schedule and order limits that the whole simulator shares."""
