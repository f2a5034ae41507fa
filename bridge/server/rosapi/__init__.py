"""The `rosapi` services, by which ROS clients find out what a robot offers."""
