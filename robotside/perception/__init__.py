"""What the robot's sensors see: intruders, in the camera picture and on the map."""
