"""Small wrong changes of Python code, as replacements of bytes: what benchmarks/mutants.py draws from.

Left alone: annotations, strings, what a raise says, decorators, and imports for types.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

COMPARISONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "in": "not in", "is": "is not"}
REVERSED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
ARITHMETIC = {"+": "-", "-": "+", "*": "/", "/": "*", "//": "*", "%": "*", "**": "*", "&": "|", "|": "&", "@": "*"}
CALLS = {
    "min": "max", "minimum": "maximum", "amin": "amax", "any": "all", "sin": "cos", "floor": "ceil",
    "argmin": "argmax", "flatnonzero": "argwhere", "radians": "degrees", "sort": "array",
}  # fmt: skip
CALLS |= {second: first for first, second in list(CALLS.items())[:8]}
SYMBOLS: dict[type[ast.AST], str] = {
    ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!=", ast.In: "in", ast.Is: "is",
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.FloorDiv: "//", ast.Mod: "%", ast.Pow: "**",
    ast.BitAnd: "&", ast.BitOr: "|", ast.MatMult: "@", ast.And: "and", ast.Or: "or",
}  # fmt: skip


@dataclass(frozen=True)
class Mutation:
    """One wrong change."""

    path: str
    """Of the module, relative to the repository."""
    kind: str
    start: int
    """First byte that is replaced."""
    end: int
    line: int
    last_line: int
    before: str
    after: str

    def applied(self, source: bytes) -> bytes:
        """`source` with the change."""
        return source[: self.start] + self.after.encode() + source[self.end :]

    @property
    def place(self) -> str:
        """FILE:LINE."""
        return f"{self.path}:{self.line}"

    def __str__(self) -> str:
        before, after = (" ".join(text.split())[:60] for text in (self.before, self.after))
        return f"{self.place} {self.kind}: {before!r} -> {after!r}"


def mutations(path: str, source: bytes) -> Iterator[Mutation]:
    """Every change that can be made to the module `path`."""
    yield from _Finder(path, source).found


class _Finder(ast.NodeVisitor):
    def __init__(self, path: str, source: bytes) -> None:
        self._path, self._source = path, source
        self._lines = [0]
        for line in source.splitlines(keepends=True):
            self._lines.append(self._lines[-1] + len(line))
        self.found: list[Mutation] = []
        self.visit(ast.parse(source))

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        """Messages are not mutated."""

    def visit_arguments(self, node: ast.arguments) -> None:
        """Defaults, without annotations."""
        for value in (*node.defaults, *node.kw_defaults):
            if value is not None:
                self.visit(value)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        """The body, without decorators and annotations."""
        self.visit(node.args)
        for statement in node.body:
            self.visit(statement)

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        """The body alone."""
        for statement in node.body:
            self.visit(statement)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        """The value alone."""
        if node.value is not None:
            self.visit(node.value)

    def visit_If(self, node: ast.If) -> None:
        """Negate the condition."""
        if isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            return
        self._negate(node.test)
        self.generic_visit(node)

    def visit_IfExp(self, node: ast.IfExp) -> None:
        """Negate the condition."""
        self._negate(node.test)
        self.generic_visit(node)

    def visit_Raise(self, node: ast.Raise) -> None:
        """Drop it; what it says does not count."""
        self._add("statement", *self._span(node), "pass", node)

    def visit_Expr(self, node: ast.Expr) -> None:
        """Drop calls."""
        if isinstance(node.value, ast.Call):
            self._add("statement", *self._span(node), "pass", node)
        self.generic_visit(node)

    def visit_AugAssign(self, node: ast.AugAssign) -> None:
        """Drop it."""
        self._add("statement", *self._span(node), "pass", node)
        self.generic_visit(node)

    def visit_Assign(self, node: ast.Assign) -> None:
        """Drop assignments into arrays."""
        if all(isinstance(target, ast.Subscript) for target in node.targets):
            self._add("statement", *self._span(node), "pass", node)
        self.visit(node.value)

    def visit_Compare(self, node: ast.Compare) -> None:
        """Shift the border, and turn inequalities round."""
        sides = [node.left, *node.comparators]
        for k, operator in enumerate(node.ops):
            symbol = SYMBOLS.get(type(operator), "")
            if symbol in COMPARISONS:
                self._between("comparison", sides[k], sides[k + 1], symbol, COMPARISONS[symbol])
            if symbol in REVERSED:
                self._between("comparison", sides[k], sides[k + 1], symbol, REVERSED[symbol])
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        """Another operation."""
        symbol = SYMBOLS.get(type(node.op), "")
        if symbol in ARITHMETIC:
            kind = "sign" if symbol in "+-" else "arithmetic"
            self._between(kind, node.left, node.right, symbol, ARITHMETIC[symbol])
        self.generic_visit(node)

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        """And for or."""
        symbol = SYMBOLS[type(node.op)]
        for first, second in zip(node.values, node.values[1:], strict=False):
            self._between("condition", first, second, symbol, "or" if symbol == "and" else "and")
        self.generic_visit(node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        """Drop the minus or the not."""
        start, end = self._span(node)
        if isinstance(node.op, ast.USub):
            self._add("sign", start, end, self._text(node.operand), node)
        elif isinstance(node.op, ast.Not):
            self._add("condition", start, end, self._text(node.operand), node)
        self.generic_visit(node)

    def visit_Call(self, node: ast.Call) -> None:
        """Min for max and the like."""
        function = node.func
        name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
        if name in CALLS:
            _, end = self._span(function)
            self._add("call", end - len(name), end, CALLS[name], node)
        self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        """Another number, or the other truth value."""
        start, end = self._span(node)
        if isinstance(node.value, bool):
            self._add("constant", start, end, str(not node.value), node)
        elif isinstance(node.value, int):
            self._add("constant", start, end, str(node.value + 1), node)
        elif isinstance(node.value, float):
            self._add("constant", start, end, repr(2.0 * node.value if node.value else 1.0), node)

    def _negate(self, test: ast.expr) -> None:
        start, end = self._span(test)
        self._add("condition", start, end, f"not ({self._text(test)})", test)

    def _between(self, kind: str, left: ast.expr, right: ast.expr, symbol: str, other: str) -> None:
        """Replace the operator between two operands; parentheses and comments may stand there too."""
        start, end = self._span(left)[1], self._span(right)[0]
        at = self._source.find(symbol.encode(), start, end)
        if at >= 0 and b"#" not in self._source[start:end]:
            self._add(kind, at, at + len(symbol), other, left, right)

    def _span(self, node: ast.expr | ast.stmt) -> tuple[int, int]:
        if node.end_lineno is None or node.end_col_offset is None:
            raise ValueError(f"line {node.lineno}: a node without an end, which ast.parse does not make.")
        start = self._lines[node.lineno - 1] + node.col_offset
        return start, self._lines[node.end_lineno - 1] + node.end_col_offset

    def _text(self, node: ast.expr) -> str:
        start, end = self._span(node)
        return self._source[start:end].decode()

    def _add(
        self, kind: str, start: int, end: int, after: str, node: ast.expr | ast.stmt, last: ast.expr | None = None
    ) -> None:
        before = self._source[start:end].decode()
        # Lines keep their numbers, by which tests are chosen.
        after += "\n" * (before.count("\n") - after.count("\n")) if kind == "statement" else ""
        last_line = (last or node).end_lineno or node.lineno
        self.found.append(Mutation(self._path, kind, start, end, node.lineno, last_line, before, after))
