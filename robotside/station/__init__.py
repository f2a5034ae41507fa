"""One robot's side as a whole, without sockets."""
