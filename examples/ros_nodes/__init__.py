"""A small set of nodes as most ROS systems have them: add_two_ints, fibonacci, listener, tf2_web_republisher.

`python -m examples.ros_nodes --connect ws://127.0.0.1:9090` brings them to a robot; any rosbridge client finds them there, in the
manner of ROS 1 and in that of ROS 2.
"""
