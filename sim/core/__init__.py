"""What all rooms of the simulator share: tables of figures, noise, the schedule of sensors, limits of orders."""
