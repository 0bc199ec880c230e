"""Options that several verbs of ``formicarium campaign`` share."""

from typing import Annotated

from cyclopts import Parameter

Settings = Annotated[list[str] | None, Parameter(name="--set", negative="")]
Switch = Annotated[bool, Parameter(negative="")]
