"""What can go wrong with a campaign as a whole. Light to import: the command line catches these."""


class DesignError(Exception):
    """A design cannot be run as it is; the message names the file, the key and the value."""


class Futile(Exception):
    """Raised by a function when no further run can succeed: the campaign stops instead of failing run by run."""


class Explained(Exception):
    """A run has failed for a reason that the message says in full: no traceback is shown."""


class CrewError(Exception):
    """Workers cannot be had, or are gone; what was kept before stays."""
