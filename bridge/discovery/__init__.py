"""The local network: beacons by which robots and handhelds find each other, and changes of the route to a robot."""
