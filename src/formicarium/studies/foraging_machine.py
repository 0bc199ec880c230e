"""Figure 3 from the implementation: the transitions are read off the source of ``behaviour.py``.

Every call ``enter(memory, State.X, ...)`` that the function of a state leads to is an arc. Where the state entered
depends on the label just drawn, the arcs are P_p and 1 - P_p; behind ``gives_up`` they are P_g.
"""

import ast
from collections.abc import Iterator, Mapping
from importlib import resources
from typing import Any

from formicarium.studies.diagram import Arc, Machine
from formicarium.systems.partitioning.memory import State

CHOSEN, NOT_CHOSEN, GIVEN_UP = "P_p", "1 - P_p", "P_g"

# Source on the left, nest on the right, corridor below, as in the arena.
LEFT = {
    "GO_SOURCE": (1.1, 6.0),
    "ENTER_SOURCE": (2.2, 4.3),
    "TO_CACHE_DROP": (4.3, 4.3),
    "WAIT_DROP": (6.0, 3.0),
    "ENTER_DROP": (6.1, 5.1),
    "DROPPING": (3.8, 6.0),
}
WIDTH = 15.0
MIRRORED = {
    "GO_SOURCE": "GO_NEST",
    "ENTER_SOURCE": "ENTER_NEST",
    "TO_CACHE_DROP": "TO_CACHE_PICK",
    "WAIT_DROP": "WAIT_PICK",
    "ENTER_DROP": "ENTER_PICK",
    "DROPPING": "PICKING",
}
COLOURS = {"CORRIDOR": "#eeeeee", "SOURCE": "#d6f5c3", "NEST": "#cfe8f5", "": "#ffe3a3"}


def arcs() -> list[Arc]:
    """Return all transitions between different states, in the order of the states."""
    source = resources.files("formicarium.systems.partitioning").joinpath("behaviour.py").read_text(encoding="utf-8")
    functions = {node.name: node for node in ast.parse(source).body if isinstance(node, ast.FunctionDef)}
    found: dict[Arc, None] = {}
    for state, call in _dispatched(functions["decide"]):
        for target, label in _entered(call, functions, {}):
            if target != state:
                found[Arc(state, target, label)] = None
    order = [state.name for state in State]
    return sorted(found, key=lambda arc: (order.index(arc.start), order.index(arc.end)))


def machine() -> Machine:
    """Return the diagram."""
    places = dict(LEFT) | {MIRRORED[name]: (WIDTH - x, y) for name, (x, y) in LEFT.items()}
    places |= {"CORRIDOR_TO_NEST": (WIDTH / 2 - 0.5, 1.35), "CORRIDOR_TO_SOURCE": (WIDTH / 2 + 0.5, 0.5)}
    colours = {name: COLOURS[next(key for key in COLOURS if key in name)] for name in places}
    note = "read off behaviour.py; named arcs: choices of the robot; HARVESTED and STORED last no time"
    bends = {("CORRIDOR_TO_NEST", "GO_NEST"): 0.45, ("CORRIDOR_TO_SOURCE", "GO_SOURCE"): -0.45}
    bends |= {("TO_CACHE_DROP", "ENTER_DROP"): 0.15, ("ENTER_DROP", "TO_CACHE_DROP"): 0.15}
    bends |= {("WAIT_DROP", "ENTER_DROP"): 0.12, ("ENTER_DROP", "WAIT_DROP"): 0.12}
    bends |= {("GO_SOURCE", "ENTER_SOURCE"): 0.12, ("ENTER_SOURCE", "GO_SOURCE"): 0.12}
    bends |= {(MIRRORED[start], MIRRORED[end]): bend for (start, end), bend in list(bends.items()) if start in MIRRORED}
    return Machine("Fig. 3: the states of a robot", note, places, colours, arcs(), bends)


def _dispatched(decide: ast.FunctionDef) -> Iterator[tuple[str, ast.Call]]:
    """Yield each state with the call that the switch of ``decide`` makes in it."""
    for node in ast.walk(decide):
        if isinstance(node, ast.If) and isinstance(node.test, ast.Compare):
            compared = node.test.comparators[0]
            if ast.unparse(node.test.left) == "memory.state" and isinstance(compared, ast.Attribute):
                call = node.body[0]
                assert isinstance(call, ast.Expr) and isinstance(call.value, ast.Call)
                yield compared.attr, call.value


def _entered(
    call: ast.Call, functions: Mapping[str, ast.FunctionDef], known: Mapping[str, Any], label: str = ""
) -> Iterator[tuple[str, str]]:
    """Yield the states that a call leads to, with the choice on the way."""
    if not isinstance(call.func, ast.Name):
        return
    if call.func.id == "enter":
        yield from _states(call.args[1], known, label)
    elif call.func.id in functions:
        function = functions[call.func.id]
        names = [argument.arg for argument in function.args.args]
        bound = {name: _constant(value, known) for name, value in zip(names, call.args, strict=True)}
        for statement in function.body:
            yield from _of_statement(statement, functions, bound, label)


def _of_statement(
    statement: ast.AST, functions: Mapping[str, ast.FunctionDef], known: Mapping[str, Any], label: str
) -> Iterator[tuple[str, str]]:
    if isinstance(statement, ast.If):
        inside = GIVEN_UP if "gives_up(" in ast.unparse(statement.test) else label
        for part in statement.body:
            yield from _of_statement(part, functions, known, inside)
        for part in statement.orelse:
            yield from _of_statement(part, functions, known, label)
        return
    for node in ast.walk(statement):
        if isinstance(node, ast.Call):
            yield from _entered(node, functions, known, label)


def _states(node: ast.expr, known: Mapping[str, Any], label: str) -> Iterator[tuple[str, str]]:
    if isinstance(node, ast.Attribute):
        yield node.attr, label
    elif isinstance(node, ast.IfExp):
        test = ast.unparse(node.test)
        if known.get(test) is not None:
            yield from _states(node.body if known[test] else node.orelse, known, label)
        elif test == "memory.label == Label.CACHE":
            yield from _states(node.body, known, CHOSEN)
            yield from _states(node.orelse, known, NOT_CHOSEN)
        else:
            yield from _states(node.body, known, label)
            yield from _states(node.orelse, known, label)


def _constant(node: ast.expr, known: Mapping[str, Any]) -> Any:
    if isinstance(node, ast.Constant):
        return node.value
    return known.get(node.id) if isinstance(node, ast.Name) else None
