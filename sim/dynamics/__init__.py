"""Forces, drives and free-body motion that the vehicles are built from."""
