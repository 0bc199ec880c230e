"""Real robots: bytes on a line turned into Readings and Commands. None of it has met hardware yet.

A room of its own and no part of ``robots``: a driver decides no simulated result, so an edit here outdates no run.
"""
