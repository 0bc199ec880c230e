"""Parts of the package that need more than the base installation."""

from importlib.util import find_spec

from formicarium.commands.errors import UserError

MODULES = {
    "watch": ("starlette", "uvicorn", "websockets"),
    "movie": ("imageio_ffmpeg",),
    "mcap": ("foxglove",),
    "scheduling": ("highspy",),
    "cluster": ("distributed", "dask_jobqueue"),
    "rl": ("pettingzoo", "gymnasium"),
}


def require(extra: str, purpose: str) -> None:
    """Check that an extra is installed.

    Raises:
        UserError: if not; says what to type.
    """
    missing = [name for name in MODULES[extra] if find_spec(name) is None]
    if missing:
        raise UserError(
            f"{purpose} needs {' and '.join(missing)}, which {'is' if len(missing) == 1 else 'are'} not installed. "
            f'Type: python -m pip install "formicarium[{extra}]"'
        )
