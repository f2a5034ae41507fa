"""Interfaces of voice: what any recogniser or speaker offers, and the events that it sends."""
