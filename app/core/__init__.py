"""What all rooms stand on: settings, a worker thread, the origin of a command."""
