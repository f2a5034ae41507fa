"""Webhooks: a robot's events sent to the web servers of those who asked for them."""
