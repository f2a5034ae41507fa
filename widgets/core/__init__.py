"""Core of every widget: states and ages, themes, shapes on a canvas, arithmetic, words of tasks."""
