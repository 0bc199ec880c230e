"""``formicarium describe SYSTEM``: every parameter of a system."""

WIDTH = 200  # characters


def describe(system: str, /) -> None:
    """Show all parameters of a system: name, default, unit, allowed values, and where the number is from.

    Examples:
        formicarium describe mark-i3

    Parameters
    ----------
    system
        Name of the system; list them with: formicarium systems
    """
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    from formicarium.commands.fields import fields
    from formicarium.commands.known import find_system

    found = find_system(system)
    console = Console()
    if not console.is_terminal:
        console = Console(width=WIDTH)  # for grep and files: one parameter a line
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column("name", no_wrap=True)
    for title in ("default", "unit", "allowed", "what it is, and its source"):
        table.add_column(title, overflow="fold")
    content = found.configure().model_dump()
    group = ""
    for field in fields(found.parameters):
        value = content
        for part in field.path.split("."):
            value = value[part]
        if group and group != field.path.rpartition(".")[0]:
            table.add_row()
        group = field.path.rpartition(".")[0]
        cells = (field.path, str(value), field.unit, field.allowed, field.info.description or "")
        table.add_row(*map(escape, cells))  # "[m]" is a unit here, not markup
    console.print(f"{found.name}: {found.summary}\n", highlight=False)
    console.print(table)
    console.print(
        f"\nChange one with: formicarium run {system} --set NAME=VALUE\n"
        "The last part of a name is enough where it is unique.",
        highlight=False,
    )
