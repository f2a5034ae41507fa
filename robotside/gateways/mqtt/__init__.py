"""MQTT 5: a robot's topics, services and STOP at a broker, with a birth, a last will and a guide."""
