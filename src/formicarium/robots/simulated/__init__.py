"""Simulated sensors and actuators, one a file. A sensor's docstring is its equation."""
