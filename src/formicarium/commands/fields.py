"""Parameters by name: every field of the nested groups, and ``--set name=value`` for any of them."""

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import Annotated, Any, NamedTuple

from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo

from formicarium.commands.errors import UserError, near


class NamedField(NamedTuple):
    """One number of a system's parameters."""

    path: str  # "booth.task_time"
    info: FieldInfo

    @property
    def name(self) -> str:
        """Last part of the path."""
        return self.path.rpartition(".")[2]

    @property
    def unit(self) -> str:
        """Unit as noted beside the field, empty if there is none."""
        extra = self.info.json_schema_extra
        return str(extra.get("unit", "")) if isinstance(extra, dict) else ""

    @property
    def allowed(self) -> str:
        """Allowed range or values in words, empty if anything of the type goes."""
        found = {
            name: getattr(limit, name)
            for limit in self.info.metadata
            for name in ("ge", "gt", "le", "lt")
            if getattr(limit, name, None) is not None
        }
        if {"ge", "le"} <= found.keys():
            parts = [f"{found['ge']:g} to {found['le']:g}"]
        else:
            words = {"ge": "at least", "gt": "above", "le": "at most", "lt": "below"}
            parts = [f"{words[name]} {limit:g}" for name, limit in found.items()]
        adapter: TypeAdapter[Any] = TypeAdapter(Any if self.info.annotation is None else self.info.annotation)
        schema = adapter.json_schema()
        if "enum" in schema:
            parts.append("one of " + ", ".join(map(str, schema["enum"])))
        return ", ".join(parts)


def fields(model: type[BaseModel], prefix: str = "") -> Iterator[NamedField]:
    """Yield every field of a model and of the groups in it, with dotted paths."""
    for name, info in model.model_fields.items():
        if isinstance(info.annotation, type) and issubclass(info.annotation, BaseModel):
            yield from fields(info.annotation, f"{prefix}{name}.")
        else:
            yield NamedField(f"{prefix}{name}", info)


def with_settings(parameters: BaseModel, settings: Iterable[str]) -> BaseModel:
    """Return the parameters with settings like "booth.task_time=8" or "dwell_time=8" made.

    Raises:
        UserError: if a name is unknown or ambiguous, or a value not allowed.
    """
    values = {}
    for setting in settings:
        name, text = parted(setting)
        field = find_field(type(parameters), name, f"--set {name}")
        values[field.path] = value_of_text(field, text)
    return with_values(parameters, values)


def parted(setting: str) -> tuple[str, str]:
    """Take "name=value" apart.

    Raises:
        UserError: if there is no "=".
    """
    name, equals, text = setting.partition("=")
    if not equals:
        raise UserError(f"--set {setting}: expected name=value, for example --set {name}=1")
    return name.strip(), text.strip()


def with_values(parameters: BaseModel, values: Mapping[str, Any]) -> BaseModel:
    """Return the parameters with these values, given by dotted path, and checked as a whole.

    Raises:
        UserError: if they do not go together.
    """
    content = parameters.model_dump()
    for path, value in values.items():
        *groups, last = path.split(".")
        place = content
        for group in groups:
            place = place[group]
        place[last] = value
    try:
        return type(parameters).model_validate(content)
    except ValidationError as error:
        raise UserError(in_words(error)) from error


def in_words(error: ValidationError) -> str:
    """Say which fields of a model are wrong and why."""
    lines = [
        f"{'.'.join(map(str, problem['loc'])) or 'parameters'}: {problem['msg'].removeprefix('Value error, ')}"
        + (f" (got {problem['input']!r})" if not isinstance(problem["input"], dict | BaseModel) else "")
        for problem in error.errors()
    ]
    return "; ".join(lines)


def find_field(model: type[BaseModel], name: str, said: str) -> NamedField:
    """Return the field of this dotted or bare name.

    Args:
        model: whose fields to look through.
        name: of the field.
        said: where the name comes from, for messages ("--set spacing").

    Raises:
        UserError: if no field has the name, or several do.
    """
    known = list(fields(model))
    exact = [field for field in known if field.path == name]
    matches = exact or [field for field in known if field.name == name]
    if len(matches) == 1:
        return matches[0]
    if matches:
        raise UserError(f"{said}: ambiguous, say which: {', '.join(field.path for field in matches)}")
    names = [field.path for field in known] + [field.name for field in known]
    close = near(name, dict.fromkeys(names))
    raise UserError(f"{said}: no parameter has that name.{close} List them with: formicarium describe SYSTEM")


def typed_value(field: NamedField, value: Any, said: str) -> Any:
    """Check a value that has a type already, as in a file: a text is no number, true is no 1.

    Raises:
        UserError: if it is not allowed.
    """
    try:
        return _adapter(field).validate_json(json.dumps(value), strict=True)
    except ValidationError as error:
        raise _refused(field, f"{said} = {json.dumps(value)}", error) from error


def value_of_text(field: NamedField, text: str) -> Any:
    """Read a value as plain text, as JSON ("[1, 2]", "null") or as a list without brackets ("1,2").

    Raises:
        UserError: if it is not allowed.
    """
    adapter, problem = _adapter(field), None
    for read in (str, json.loads, lambda text: json.loads(f"[{text}]")):
        try:
            return adapter.validate_python(read(text))
        except ValidationError as error:
            problem = problem or error
        except ValueError:
            continue
    assert problem is not None  # reading as plain text cannot fail otherwise
    raise _refused(field, f"--set {field.path}={text}", problem)


def _adapter(field: NamedField) -> TypeAdapter[Any]:
    bounded: Any = Annotated[field.info.annotation, field.info]
    return TypeAdapter(bounded)


def _refused(field: NamedField, said: str, error: ValidationError) -> UserError:
    allowed = f"; allowed: {field.allowed}" + (f" {field.unit}" if field.unit not in ("", "1") else "")
    return UserError(f"{said}: {error.errors()[0]['msg']}{allowed if field.allowed else ''}")
