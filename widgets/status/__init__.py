"""Events, checks and the cards that say what needs attention."""
