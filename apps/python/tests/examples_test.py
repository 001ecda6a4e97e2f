# SPDX-License-Identifier: Apache-2.0
"""The examples run, and what they show is true."""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import matplotlib  # noqa: F401
except ImportError:
    print("python3-matplotlib is missing: the examples are not run")
    sys.exit(77)

EXAMPLES = Path(__file__).parents[3] / "examples" / "python"


class Examples(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def said_by(self, example, *arguments):
        done = subprocess.run([sys.executable, EXAMPLES / example, *arguments], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_larger_lamps_have_wider_penumbrae(self):
        said = self.said_by("first.py")
        shares = [float(share) for share in re.findall(r"([\d.]+)% of the picture", said)]
        self.assertEqual(len(shares), 4, said)
        self.assertEqual(shares, sorted(shares))
        self.assertTrue((self.folder / "picture.png").exists())

    def test_more_samples_err_less(self):
        said = self.said_by("sweep.py", "--size", "96x54", "--truth", "256", "--runs", "1", "-o", "plot.svg")
        self.assertGreater((self.folder / "plot.svg").read_text().count("<path"), 50, "an empty plot")
        errors = [float(error) for error in re.findall(r"  exact +samples +\d+:.*error ([\d.]+)", said)]
        self.assertEqual(len(errors), 9, said)
        for few, some, many in zip(errors[0::3], errors[1::3], errors[2::3]):
            self.assertGreater(few, some)
            self.assertGreater(some, many)


if __name__ == "__main__":
    unittest.main()
