"""Intents: what was understood, who may ask for it, and how it is carried out."""
