"""What was run: a name, its parameters and the sources that decide the results."""

import hashlib
import json
from collections.abc import Mapping
from typing import Any, NamedTuple


class Configuration(NamedTuple):
    """Everything that decides the result of a run besides its seed, and the version for people to read."""

    system: str  # name of what is run
    parameters: Mapping[str, Any]  # nested groups of plain values
    sources: str  # hash of the sources that decide results
    version: str  # of the package; for information, not part of the identity

    @property
    def identity(self) -> str:
        """Hash of name, sorted parameters and sources: 16 hexadecimal digits."""
        text = json.dumps(
            {"system": self.system, "parameters": self.parameters, "sources": self.sources}, sort_keys=True
        )
        return hashlib.blake2b(text.encode(), digest_size=8).hexdigest()

    def content(self) -> dict[str, Any]:
        """Return what is written to ``configuration.json``."""
        return {**self._asdict(), "identity": self.identity}


def difference(stored: Mapping[str, Any], wanted: Mapping[str, Any]) -> str:
    """Say in a few words how two contents of ``configuration.json`` differ."""
    if stored.get("system") != wanted["system"]:
        return f"it holds runs of {stored.get('system')}"
    before, after = _flat(stored.get("parameters", {})), _flat(wanted["parameters"])
    changed = [name for name in sorted({*before, *after}) if before.get(name) != after.get(name)]
    if changed:
        shown = [f"{name} = {before.get(name)}, now {after.get(name)}" for name in changed[:3]]
        more = f" and {len(changed) - 3} more" if len(changed) > 3 else ""
        return f"it holds runs with {'; '.join(shown)}{more}"
    return "the sources that decide results have changed since"


def _flat(group: Any, prefix: str = "") -> dict[str, Any]:
    if not isinstance(group, Mapping):
        return {prefix: group}
    return {
        path: value
        for name, inner in group.items()
        for path, value in _flat(inner, f"{prefix}.{name}" if prefix else name).items()
    }
