"""Shakes of the handheld as commands: the recogniser, what it goes by, and the lesson that fits it to one person."""

from app.inputs.motion.shake.lesson import Lesson
from app.inputs.motion.shake.recogniser import MIN_RATE, Recogniser, Shake
from app.inputs.motion.shake.tuning import (
    AXES,
    USUAL,
    WORDS,
    Axis,
    PersonalAxis,
    Tuning,
    fitted,
    own_from,
    own_to,
)

__all__ = [
    "AXES",
    "MIN_RATE",
    "USUAL",
    "WORDS",
    "Axis",
    "Lesson",
    "PersonalAxis",
    "Recogniser",
    "Shake",
    "Tuning",
    "fitted",
    "own_from",
    "own_to",
]
