"""Packages that garden publishes for Kivy."""
