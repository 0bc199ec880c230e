"""Tables of named numbers: validated when they are set, plain records when compiled code reads them."""

from typing import Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field


def number(default: Any, unit: str, description: str, **bounds: Any) -> Any:
    """Declare one number of a table with its unit, its reason or source, and its bounds (ge, gt, le, lt).

    A list of numbers can be declared too; it stays in Python and does not reach the record.
    """
    return Field(default, description=description, json_schema_extra={"unit": unit}, **bounds)


class Table(BaseModel):
    """A group of named numbers. Unknown names, wrong types and values out of bounds are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True, allow_inf_nan=False)

    @classmethod
    def layout(cls) -> np.dtype:
        """Return the record layout: f8 for real numbers, i8 for whole numbers and switches."""
        kinds = {float: "f8", int: "i8", bool: "i8"}
        fields: list[Any] = [
            (name, kinds[field.annotation]) for name, field in cls.model_fields.items() if field.annotation in kinds
        ]
        return np.dtype(fields, align=True)

    def record(self) -> np.recarray:
        """Return the numbers as an array of one record, fields in the order of the table."""
        layout = self.layout()
        record = np.zeros(1, layout).view(np.recarray)
        for name in layout.names or ():
            record[0][name] = getattr(self, name)
        return record
