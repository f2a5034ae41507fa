"""Android's own speech: its recogniser and its voice."""
