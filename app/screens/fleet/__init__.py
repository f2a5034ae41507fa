"""All robots that are known, while one of them is on the glass."""
