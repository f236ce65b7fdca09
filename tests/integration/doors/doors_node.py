# SPDX-License-Identifier: Apache-2.0
"""A node for the tests of the Python package: its module counts, and its other variables are of every kind."""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest


def _options():
    parser = argparse.ArgumentParser()
    for option in ("indurop", "module", "package"):
        parser.add_argument("--" + option, required=True)
    for option in ("glb2idl", "mypy", "two-boards"):
        parser.add_argument("--" + option)
    found, sys.argv[1:] = parser.parse_known_args()
    sys.path.insert(0, found.package)
    return found


OPTIONS = _options()
import indurop  # noqa: E402  from --package

PATIENCE = 60
XML = """<root><module><filename>{file}</filename><moduletype>thread</moduletype>
<operationtype>periodic</operationtype><period>1ms</period><priority>1</priority></module></root>
"""


def wait_until(what, condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"waited in vain until {what}")
        time.sleep(0.01)


class NodeTest(unittest.TestCase):
    def setUp(self):
        self.work = pathlib.Path(tempfile.mkdtemp(prefix="python_test_"))
        os.environ["INDUROP_STATE_DIR"] = str(self.work / "state")
        shutil.copy(OPTIONS.module, self.work)
        (self.work / "module.xml").write_text(self.configuration())
        self.name = f"python{os.getpid()}"
        self.process = None
        self.start()
        self.node = indurop.node(self.name, write=True)

    def configuration(self):
        return XML.format(file=pathlib.Path(OPTIONS.module).name)

    def tearDown(self):
        self.node.close()
        self.stop()
        subprocess.run([OPTIONS.indurop, "clean", "--node", self.name], capture_output=True, check=False)
        shutil.rmtree(self.work)

    def start(self):
        self.process = subprocess.Popen([OPTIONS.indurop, "run", "module.xml", "--node", self.name, "-q"], cwd=self.work,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until("the node counts", self.counts)

    def counts(self):
        try:
            with indurop.node(self.name) as node:
                return node.running and node["count"] > 0
        except indurop.Error:
            return False

    def stop(self):
        if self.process is not None:
            self.process.terminate()
            self.process.wait(PATIENCE)

    def shown_value(self, name):
        """The value as the command line has it."""
        done = subprocess.run([OPTIONS.indurop, "get", "--node", self.name, "-o", "json", name], capture_output=True,
                              text=True, check=True)
        return json.loads(done.stdout)["values"][0]["value"]

    def indurop(self, *words, code=0):
        """Runs the command line, and returns what it prints."""
        done = subprocess.run([OPTIONS.indurop, *words], cwd=self.work, capture_output=True, text=True, check=False,
                              timeout=PATIENCE)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout
