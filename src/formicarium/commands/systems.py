"""``formicarium systems``: which systems there are."""


def systems() -> None:
    """List the systems that can be run, the package's own and those of other installed packages."""
    from rich.console import Console
    from rich.table import Table

    from formicarium.systems.registry import UnknownSystem, names, resolve

    table = Table(box=None, pad_edge=False, padding=(0, 2))
    for title in ("system", "what it is"):
        table.add_column(title, overflow="fold")
    for name in names():
        try:
            table.add_row(name, resolve(name).summary)
        except UnknownSystem as error:
            table.add_row(name, str(error))
    console = Console()
    console.print(table)
    console.print("\nRun one with: formicarium run SYSTEM", highlight=False)
