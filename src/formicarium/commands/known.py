"""Systems and their parameters as a person names them."""

from collections.abc import Iterable

from pydantic import BaseModel, ValidationError

from formicarium.commands.errors import UserError, near
from formicarium.commands.fields import in_words, with_settings
from formicarium.systems.registry import BrokenSystem, System, UnknownSystem, names, resolve


def find_system(name: str) -> System:
    """Return a system by name.

    Raises:
        UserError: if there is none of that name; lists those there are.
    """
    try:
        return resolve(name)
    except BrokenSystem as error:
        raise UserError(str(error)) from error
    except UnknownSystem as error:
        raise UserError(f"{error}.{near(name, names())}") from error


def parameters_of(system: System, setting: int | None, robots: int | None, settings: Iterable[str]) -> BaseModel:
    """Return the parameters of a published setting, with a number of robots and single settings changed.

    Raises:
        UserError: if one of them is not allowed.
    """
    given = {"setting": setting, "robots": robots}
    said = [f"--{name} {value}" for name, value in given.items() if value is not None]
    options = f"{' '.join(said)}: " if said else ""
    try:
        parameters = system.configure(setting=setting, robots=robots)
    except ValidationError as error:
        raise UserError(f"{options}{in_words(error)}") from error
    except ValueError as error:
        raise UserError(f"{options}{error}") from error
    return checked(system, with_settings(parameters, settings))


def checked(system: System, parameters: BaseModel) -> BaseModel:
    """Return the parameters, if what is to fail by the system's name is there.

    Raises:
        UserError: naming the robot or device that is not.
    """
    if "+" in system.name and system.begin is not None:  # a trial's state knows what there is
        try:
            system.begin(parameters, 0)
        except ValueError as error:
            raise UserError(str(error)) from error
    return parameters
