"""Tasks, queue, schedule, history and places."""
