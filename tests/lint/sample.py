"""A tree of sources for the self-tests of the lints."""

import pathlib
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parent.parent
HEAD = "// SPDX-License-Identifier: Apache-2.0\n// Sample.\n\n"


class Sample(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def put(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text.encode())

    def found(self, findings, *words):
        """Exactly one finding, which holds all words."""
        self.assertEqual(len(findings := list(findings)), 1, findings)
        for word in words:
            self.assertIn(word, findings[0])
