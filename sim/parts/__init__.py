"""Things from files of other programs, glTF and URDF, as the shapes that the simulator knows."""
