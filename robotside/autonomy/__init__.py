"""The robot's own mind: it knows where the robot is, sees, runs tasks and watches battery and sensors."""
