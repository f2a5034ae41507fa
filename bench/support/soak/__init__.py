"""A robot side that serves for hours: its visitors, its counts, and whether anything grows."""
