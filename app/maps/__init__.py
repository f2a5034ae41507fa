"""Maps of the operator's own choice: where their pictures come from, which of them covers the robot, and what is kept of them."""
