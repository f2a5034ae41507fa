"""Fields of any message, as a tree that a finger folds."""
