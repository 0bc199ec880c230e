"""Robot swarms that organise their own work: run, watched, measured and compared."""

__version__ = "0.1.0"
