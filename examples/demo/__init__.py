"""The demo: the main job from first tap to STOP, by script: `python -m examples.demo`."""
