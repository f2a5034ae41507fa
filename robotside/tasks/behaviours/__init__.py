"""What the robot does about a task, as behaviour trees: each leaf is one thing done, each ending leaves it at rest."""
