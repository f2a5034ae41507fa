"""Layout files, and where everything sits on the glass."""
