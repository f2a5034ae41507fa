"""The database itself: its file, tables, migrations and the thread that writes."""
