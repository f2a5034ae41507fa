"""Sharing: how a profile of views is handed on and taken in, and what is wrong with one."""
