"""Short programs that use Pilothouse, and the demo."""
