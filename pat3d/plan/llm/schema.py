"""JSON schema of dataclasses, and dataclasses from JSON: what a model may answer follows from the types alone.

Field by field the schema has the field's type and the docstring below it, so a type that grows a field or a kind takes
its schema along. Objects are closed and every field is required, as servers with strict structured output ask for;
what is read back may leave out fields that have defaults.
"""

from __future__ import annotations

import ast
import dataclasses
import difflib
import inspect
import json
import textwrap
import types
import typing
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Literal

from pat3d.errors import AnswerError, Pat3dError

MAX_TEXT = 400
"""Characters of any text in an answer."""
MAX_ITEMS = 1000
MAX_FAULTS = 8
"""That one message names."""

_JOINERS = {0x200C: None, 0x200D: None}
"""Of letters in Persian and Hindi; no other invisible character belongs in a text."""
_PLAIN = {str: "string", int: "integer", float: "number", bool: "boolean"}


@dataclass(frozen=True, kw_only=True)
class Shape:
    """A dataclass as a model answers it."""

    kind: type
    choices: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """Valid texts of fields that the types leave open: {"PlannedObject.noun": ["mug", ...]}."""
    hidden: Mapping[str, Any] = field(default_factory=dict)
    """Values of fields that are not the model's to say: {"ScenePlan.prompt": "a mug"}."""

    def schema(self, *, strict: bool = True) -> dict[str, Any]:
        """JSON schema; without `strict`, fields that have defaults may be left out."""
        return self._object(self.kind, strict)

    def read(self, text: str) -> Any:
        """The object that `text` is JSON of.

        Raises:
            AnswerError: it is no JSON, breaks the schema, or makes no valid object.
        """
        data = self.checked(text)
        return self.made(self.kind, data)

    def checked(self, text: str) -> Any:
        """JSON data that keeps to the schema.

        Raises:
            AnswerError: see `read`.
        """
        from jsonschema import Draft202012Validator

        try:
            data = json.loads(_bare(text), parse_constant=_refused)
        except (ValueError, RecursionError) as error:
            raise AnswerError(f"the answer is not JSON: {error}") from error
        faults = sorted(
            Draft202012Validator(self.schema(strict=False)).iter_errors(data), key=lambda one: one.json_path
        )
        if faults:
            raise AnswerError("\n".join(_told(fault) for fault in faults[:MAX_FAULTS]))
        return _checked_texts(data, "$")

    def made(self, kind: Any, data: Any) -> Any:
        """An object of type `kind` from JSON data that keeps to its schema.

        Raises:
            AnswerError: its own checks refuse it.
        """
        if data is None:
            return None
        if kind in _PLAIN or typing.get_origin(kind) is Literal:
            return float(data) if kind is float else data
        if typing.get_origin(kind) is tuple:
            return tuple(self.made(typing.get_args(kind)[0], one) for one in data)
        if _is_union(kind):
            return self.made(next(one for one in typing.get_args(kind) if one is not type(None)), data)
        hints = typing.get_type_hints(kind)
        values = {name: self.made(hints[name], value) for name, value in data.items()}
        own = f"{kind.__name__}."
        values |= {name.removeprefix(own): value for name, value in self.hidden.items() if name.startswith(own)}
        try:
            return kind(**values)
        except Pat3dError as error:
            raise AnswerError(str(error)) from error

    def _object(self, kind: Any, strict: bool) -> dict[str, Any]:
        hints, docs = typing.get_type_hints(kind), _docs(kind)
        properties, required = {}, []
        for one in dataclasses.fields(kind):
            name = f"{kind.__name__}.{one.name}"
            if name in self.hidden or not one.init:
                continue
            made = self._of(hints[one.name], self.choices.get(name), strict)
            properties[one.name] = {**made, "description": docs[one.name]} if one.name in docs else made
            if strict or (one.default is dataclasses.MISSING and one.default_factory is dataclasses.MISSING):
                required.append(one.name)
        return {"type": "object", "properties": properties, "required": required, "additionalProperties": False}

    def _of(self, kind: Any, choices: Sequence[str] | None, strict: bool) -> dict[str, Any]:
        if kind in _PLAIN:
            return {"type": _PLAIN[kind], **({"enum": list(choices)} if choices else {})}
        if typing.get_origin(kind) is Literal:
            return {"type": "string", "enum": list(typing.get_args(kind))}
        if typing.get_origin(kind) is tuple:
            return {"type": "array", "items": self._of(typing.get_args(kind)[0], choices, strict)}
        if _is_union(kind):
            some = [one for one in typing.get_args(kind) if one is not type(None)]
            return {"anyOf": [*(self._of(one, choices, strict) for one in some), {"type": "null"}]}
        if dataclasses.is_dataclass(kind):
            return self._object(kind, strict)
        raise TypeError(f"a field of type {kind} has no JSON schema here.")


def _is_union(kind: Any) -> bool:
    return typing.get_origin(kind) in (typing.Union, types.UnionType)


@cache
def _docs(kind: type) -> dict[str, str]:
    """The docstring below every field; none where the source is not there."""
    try:
        body = ast.parse(textwrap.dedent(inspect.getsource(kind))).body[0]
    except (OSError, SyntaxError):
        return {}
    if not isinstance(body, ast.ClassDef):
        return {}
    found = {}
    for one, below in zip(body.body, body.body[1:], strict=False):
        match one, below:
            case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(value=ast.Constant(value=str(text))):
                found[name] = " ".join(text.split())
    return found


def _bare(text: str) -> str:
    """`text` without what models put around JSON: their thinking, a code fence."""
    text = text.rpartition("</think>")[2].strip()
    if text.startswith("```") and text.endswith("```"):
        text = text.removesuffix("```").partition("\n")[2]
    return text


def _refused(name: str) -> float:
    raise ValueError(f"{name} is no number")


def _told(fault: Any) -> str:
    """A fault of the schema in a line; long lists of valid values as the nearest ones."""
    said = repr(fault.instance)
    said = said if len(said) <= 80 else f"{said[:77]}..."
    if fault.validator == "enum":
        valid = [str(one) for one in fault.validator_value]
        near = valid if len(valid) <= 20 else difflib.get_close_matches(str(fault.instance), valid, n=5, cutoff=0.4)
        return f"{fault.json_path}: {said} is not valid. {'Valid' if near is valid else 'Nearest'}: {', '.join(near)}."
    return f"{fault.json_path}: {fault.message[:200]}"


def _checked_texts(data: Any, path: str) -> Any:
    """`data` with every run of white space in its texts as one space.

    Raises:
        AnswerError: a text is too long, or has characters that a terminal obeys; or a list is too long.
    """
    if isinstance(data, str):
        text = " ".join(data.split())
        if len(text) > MAX_TEXT or not text.translate(_JOINERS).isprintable():
            raise AnswerError(f"{path}: texts have at most {MAX_TEXT} characters, all printable.")
        return text
    if isinstance(data, dict):
        return {name: _checked_texts(child, f"{path}.{name}") for name, child in data.items()}
    if isinstance(data, list):
        if len(data) > MAX_ITEMS:
            raise AnswerError(f"{path}: a list of {len(data)} is too long; at most {MAX_ITEMS}.")
        return [_checked_texts(child, f"{path}[{at}]") for at, child in enumerate(data)]
    return data
