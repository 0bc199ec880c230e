"""Designs in files: TOML, YAML or Python."""

import runpy
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from formicarium.campaigns.errors import DesignError


def read_content(path: Path) -> dict[str, Any]:
    """Read a design as plain values; ``make_design`` checks them.

    Args:
        path: a ``.toml``, ``.yaml`` or ``.yml`` file, or a ``.py`` file that sets ``DESIGN`` to a dictionary.

    Raises:
        DesignError: if the file cannot be read as what its name says.
    """
    readers = {".toml": _toml, ".yaml": _yaml, ".yml": _yaml, ".py": _python}
    if path.suffix not in readers:
        raise DesignError(f"{path}: a design is a file that ends in {', '.join(readers)}")
    try:
        content = readers[path.suffix](path)
    except FileNotFoundError as error:
        raise DesignError(f"{path}: there is no such file") from error
    except OSError as error:
        raise DesignError(f"{path}: cannot be read ({error.strerror})") from error
    except (ValueError, yaml.YAMLError) as error:  # includes bytes that are no text
        raise DesignError(f"{path}: is not valid {path.suffix[1:].upper()}: {' '.join(str(error).split())}") from error
    if not isinstance(content, Mapping):
        raise DesignError(f"{path}: must hold keys with values, not a {type(content).__name__}")
    return dict(content)


def _toml(path: Path) -> Any:
    return tomllib.loads(path.read_text(encoding="utf-8"))


class _YamlLoader(yaml.SafeLoader):
    """YAML in which a key that is said twice is an error, as in TOML; PyYAML would drop the first in silence."""

    def construct_mapping(self, node: Any, deep: bool = False) -> dict[Any, Any]:
        keys = [key.value for key, _ in node.value]
        twice = [key for key in keys if keys.count(key) > 1]
        if twice:
            raise yaml.MarkedYAMLError(problem=f"{twice[0]!r} is there more than once", problem_mark=node.start_mark)
        return super().construct_mapping(node, deep)


def _yaml(path: Path) -> Any:
    return yaml.load(path.read_text(encoding="utf-8"), _YamlLoader)


def _python(path: Path) -> Any:
    try:
        found = runpy.run_path(str(path))
    except OSError:
        raise
    except (Exception, SystemExit) as error:  # a script that exits must not end the command as if all were done
        raise DesignError(f"{path}: {type(error).__name__}: {error}") from error
    if "DESIGN" not in found:
        raise DesignError(f"{path}: sets no DESIGN")
    return found["DESIGN"]
