"""Goals and poses that are set and sent: where the robot goes, where its arm points."""
