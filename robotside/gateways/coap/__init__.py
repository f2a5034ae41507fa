"""CoAP: a robot's topics to read and observe, its services to call and STOP, for small devices and scripts, by UDP."""
