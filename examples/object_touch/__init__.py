"""A web page of one's own that shows a robot's camera and moves its arm to touch something."""
