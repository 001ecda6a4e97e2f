# SPDX-License-Identifier: Apache-2.0
"""The stubs serve mypy: they and the examples are clean, and what is wrong is found."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import penumbra

EXAMPLES = Path(__file__).parents[3] / "examples" / "python"


def mypy(*arguments):
    """What mypy of the Python that penumbra is imported by says, and its exit code."""
    modules = Path(penumbra.__file__).parents[1]
    with tempfile.TemporaryDirectory() as cache:
        done = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", cache, "--ignore-missing-imports",
                               *map(str, arguments)], env={**os.environ, "MYPYPATH": str(modules)},
                              capture_output=True, text=True)
    return done.stdout + done.stderr, done.returncode


if mypy("--version")[1] != 0:
    print("mypy is missing: types are not checked")
    sys.exit(77)


class Types(unittest.TestCase):
    def test_stubs_and_examples_are_clean(self):
        said, code = mypy("--strict", Path(penumbra.__file__).parent)
        self.assertEqual(code, 0, said)
        said, code = mypy("--check-untyped-defs", *EXAMPLES.glob("*.py"))
        self.assertEqual(code, 0, said)

    def test_wrong_types_are_found(self):
        wrong = ["penumbra.open_scene(name=3)", "penumbra.Renderer().render('primitives')",
                 "penumbra.open_scene('torus', up='x')", "penumbra.Camera([0, 0, 0], 'there')",
                 "len(penumbra.Renderer().device) + ''"]
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "wrong.py"
            program.write_text("import penumbra\n" + "\n".join(wrong))
            said, _ = mypy(program)
        lines = {int(line.split(":")[1]) for line in said.splitlines() if "error:" in line}
        self.assertEqual(lines, set(range(2, 2 + len(wrong))), said)


if __name__ == "__main__":
    unittest.main()
