"""Touches and what else comes from an input device."""

from kivy.input.motionevent import MotionEvent as MotionEvent
