"""Plain JSON by WebSocket: a robot's topics, services, actions and camera pictures for any program or test tool."""
