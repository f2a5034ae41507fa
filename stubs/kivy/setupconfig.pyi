USE_SDL2: int
