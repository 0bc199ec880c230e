"""The contracts of every system, held against one."""

from collections.abc import Callable
from unittest import SkipTest

from formicarium.contracts import CONTRACTS, Broken
from formicarium.systems.registry import resolve


def check_system(system: str, told: Callable[[str, str], None] | None = None) -> dict[str, str]:
    """Hold every contract against a system; it takes a minute or two.

    Args:
        system: a name of ``system_names()``, or "module:object".
        told: called with a contract's sentence and what came of it, as each is done.

    Returns:
        Sentence -> "" if the contract is kept, "-: reason" if it does not apply, otherwise what was found.

    Raises:
        UnknownSystem: if there is no such system.
    """
    resolve(system)
    found = {}
    for contract in CONTRACTS:
        sentence = str(contract.__doc__).strip()
        try:
            contract(system)
            said = ""
        except SkipTest as reason:
            said = f"-: {reason}"
        except Broken as reason:
            said = str(reason)
        except Exception as error:  # a system may fail in its own way
            said = f"{type(error).__name__}: {error}"
        found[sentence] = said
        if told:
            told(sentence, said)
    return found
