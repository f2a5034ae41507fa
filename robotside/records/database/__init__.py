"""The database: its file, tables, migrations and the thread that writes."""
