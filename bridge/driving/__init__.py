"""Driving a robot behind a server of another maker, which lets no command expire."""
