"""Everything that both ends of the socket share: messages, topics, frames, units and the rosbridge protocol."""
