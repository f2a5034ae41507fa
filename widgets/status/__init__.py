"""Status: events, checks, and cards for what needs attention."""
