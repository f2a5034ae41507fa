"""What gateways that go to a broker share: a line that comes back, who speaks there, and what is told of losses."""
