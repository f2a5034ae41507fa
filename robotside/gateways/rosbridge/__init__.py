"""The rosbridge gateway: a robot's topics, services, actions and camera frames on WebSockets."""
