"""What a contract says when it is not kept."""


class Broken(AssertionError):
    """A system does not keep a contract; says what was found and where to look."""


def require(kept: object, message: str) -> None:
    """Check one clause of a contract.

    Raises:
        Broken: with the message, if it is not kept.
    """
    if not kept:
        raise Broken(message)
