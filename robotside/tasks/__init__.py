"""Tasks from order to history: one runs at a time, others wait in the queue."""
