"""Sentences said aloud."""
