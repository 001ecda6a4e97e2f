# SPDX-License-Identifier: Apache-2.0
"""What is installed is whole: it is imported from a prefix that nothing else is in. PENUMBRA_BUILD is the build's folder."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path


class Installed(unittest.TestCase):
    def test_is_imported_with_its_stubs(self):
        with tempfile.TemporaryDirectory() as prefix:
            subprocess.run(["cmake", "--install", os.environ["PENUMBRA_BUILD"], "--prefix", prefix, "--component",
                            "python"], check=True, capture_output=True)
            modules = Path(prefix) / "lib" / "python3" / "dist-packages"
            asked = "import penumbra; print(penumbra.__file__); print(len(penumbra.scenes()))"
            said = subprocess.run([sys.executable, "-c", asked], env={"PYTHONPATH": str(modules)}, check=True,
                                  capture_output=True, text=True).stdout.split()
            self.assertEqual(Path(said[0]), modules / "penumbra" / "__init__.py")
            self.assertGreater(int(said[1]), 10)
            for file in ("__init__.pyi", "py.typed"):
                self.assertTrue((modules / "penumbra" / file).exists(), file)
            self.assertTrue((Path(prefix) / "share/doc/python3-penumbra/copyright").exists())


if __name__ == "__main__":
    unittest.main()
