"""The stations that one process serves: their sockets, their beacon, one tick for all of them."""
