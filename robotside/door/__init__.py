"""The one door by which every gateway reaches a robot; it knows no transport."""
