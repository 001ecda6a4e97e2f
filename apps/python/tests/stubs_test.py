# SPDX-License-Identifier: Apache-2.0
"""What the stubs say is there is what is there, down to the names and the defaults of arguments."""
import ast
import inspect
import re
import unittest
from pathlib import Path

import penumbra

STUBS = ast.parse(Path(penumbra.__file__).with_suffix(".pyi").read_text())
ONLY_FOR_TYPES = {"Device", "Floats", "Light"}


def in_stubs(body):
    """Name to what it is, of the definitions in a module's or class's body."""
    found = {}
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
        elif isinstance(node, ast.Assign):
            found[node.targets[0].id] = node
    return found


def is_property(node):
    return any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)


def arguments_in_stubs(function):
    """[(name, default or None)], with ("*", None) where names are needed from."""
    arguments = function.args
    without = len(arguments.args) - len(arguments.defaults)
    found = [(a.arg, ast.unparse(arguments.defaults[i - without]) if i >= without else None)
             for i, a in enumerate(arguments.args)]
    if arguments.kwonlyargs:
        found.append(("*", None))
        found += [(a.arg, ast.unparse(d) if d else None)
                  for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return found


def arguments_in_module(function):
    """The same, out of the first line of the docstring, which pybind11 writes."""
    text = re.match(r"\w+\((.*)\) -> ", function.__doc__.splitlines()[0]).group(1)
    parts, depth, start = [], 0, 0
    for i, letter in enumerate(text + ","):
        depth += letter in "([{"
        depth -= letter in ")]}"
        if letter == "," and depth == 0:
            parts.append(text[start:i].strip())
            start = i + 1
    found = []
    for part in filter(None, parts):
        name = part.split(":")[0].strip()
        default = part.rsplit(" = ", 1)[1] if " = " in part else None
        found.append((name, default))
    return found


def same_value(stub, module):
    if stub is None or module is None:
        return stub is module
    return ast.literal_eval(stub) == ast.literal_eval(module)


class Stubs(unittest.TestCase):
    def assert_same_arguments(self, name, stub, function):
        ours, theirs = arguments_in_stubs(stub), arguments_in_module(function)
        self.assertEqual([a for a, _ in ours], [a for a, _ in theirs], name)
        for (argument, default), (_, actual) in zip(ours, theirs):
            with self.subTest(function=name, argument=argument):
                self.assertTrue(same_value(default, actual), f"{default} in the stubs, {actual} in the module")

    def test_names_are_the_module_s(self):
        stubs = set(in_stubs(STUBS.body)) - ONLY_FOR_TYPES
        self.assertEqual(stubs, set(penumbra.__all__))
        public = {n for n in vars(penumbra) if not n.startswith("_")} | {"__version__"}
        self.assertEqual(stubs, public)

    def test_functions_take_the_same_arguments(self):
        for name, stub in in_stubs(STUBS.body).items():
            if isinstance(stub, ast.FunctionDef):
                self.assert_same_arguments(name, stub, getattr(penumbra, name))

    def test_classes_have_the_same_members(self):
        for name, stub in in_stubs(STUBS.body).items():
            kind = getattr(penumbra, name, None)
            if not isinstance(stub, ast.ClassDef) or name in ONLY_FOR_TYPES or issubclass(kind, Exception):
                continue
            members = in_stubs(stub.body)
            public = {n for n in vars(kind) if not n.startswith("_")}
            self.assertEqual({n for n in members if not n.startswith("_")}, public, name)
            for member, node in members.items():
                actual = getattr(kind, member)
                if is_property(node):
                    self.assertIsInstance(actual, property, f"{name}.{member}")
                else:
                    self.assert_same_arguments(f"{name}.{member}", node, actual)

    def test_everything_is_explained(self):
        for name in penumbra.__all__:
            thing = getattr(penumbra, name)
            if name == "__version__":
                continue
            self.assertTrue(inspect.getdoc(thing), name)
            for member, value in vars(thing).items() if inspect.isclass(thing) else []:
                if not member.startswith("_"):
                    self.assertTrue(inspect.getdoc(value), f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
