"""Kafka: a robot's topics, services and STOP at a broker, with a heartbeat, a birth and a guide."""
