"""Spoken commands, heard offline: what is said becomes an intent's name, how sure it is, and when it was said."""
