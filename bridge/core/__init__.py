"""What both ends of the socket share and nothing else: topics, units, geodesy, errors."""
