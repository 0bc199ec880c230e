"""What several verbs of ``formicarium campaign`` are told."""

from typing import Annotated

from cyclopts import Parameter

from formicarium.commands.whole import Whole

DesignFile = Annotated[str, Parameter(help="File of the design: .toml, .yaml or .py")]
Out = Annotated[str | None, Parameter(help="Folder of the campaign; formicarium-results/NAME if not given.")]
Runs = Annotated[
    Whole | None,
    Parameter(help="Runs of each cell, instead of the design's replicates; more of them only add."),
]
Settings = Annotated[
    list[str] | None,
    Parameter(name="--set", negative="", help="Change a parameter in all cells: NAME=VALUE, as often as needed."),
]
Sources = Annotated[
    str | None,
    Parameter(help="Take the rows that these sources made (a hash, as in the rows) instead of today's."),
]
Switch = Annotated[bool, Parameter(negative="")]
