# SPDX-License-Identifier: Apache-2.0
"""A lab that a test made, and what its boards do."""

import os
import subprocess
import time

SKIPPED = 77
PATIENCE = 1200  # seconds; translated machines on a busy host are a hundred times slower than this one


class Lab:
    def __init__(self, programs):
        self.programs = programs
        self.name = f"vm{os.getpid()}"
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}
        self.folder = None
        self.agents = []

    def __call__(self, *words, code=0, **more):
        done = subprocess.run([f"{self.programs}/indurop-lab", "-l", self.name, *words], env=self.environment, text=True,
                              capture_output=True, timeout=3000, check=False, **more)
        if code is not None and done.returncode != code:
            raise AssertionError(f"{words}: {done.returncode} instead of {code}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def agent(self, board):
        """In the background, as a person would; it ends with the board."""
        self.agents.append(subprocess.Popen(
            [f"{self.programs}/indurop-lab", "-l", self.name, "exec", board, "indurop-agent", "--board", board, "-q"],
            env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))

    def until(self, right, *words):
        """The words are repeated until what they print is right."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            said = self(*words, code=None, cwd=self.folder)
            if right(said):
                return said
            time.sleep(0.2)
        raise AssertionError(f"{words} still says:\n{said}")
