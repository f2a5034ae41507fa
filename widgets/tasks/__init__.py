"""Tasks, orders, places, missions and the schedule."""
