"""What both ends of the socket agree on: messages, topics, frames, units and the rosbridge protocol."""
