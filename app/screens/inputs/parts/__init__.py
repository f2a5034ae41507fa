"""Rows and lists that several panes of the inputs screen share."""
