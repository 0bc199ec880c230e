"""The terminal, or a file or pipe in its place."""

from rich.console import Console

WIDTH = 250  # characters


def wide_console() -> Console:
    """Return a console that breaks no lines of tables in files and pipes."""
    console = Console()
    return console if console.is_terminal else Console(width=WIDTH)
