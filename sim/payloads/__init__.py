"""Payloads that are mounted on a vehicle: rangers, a line sensor, a camera, lights, a tag reader, an arm."""

from sim.payloads.mounting import PAYLOADS, PayloadParameters, laden, load, mount, reach

__all__ = ["PAYLOADS", "PayloadParameters", "laden", "load", "mount", "reach"]
