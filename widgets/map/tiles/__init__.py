"""Tiles of maps: read, decoded and made into textures."""
