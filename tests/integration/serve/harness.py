# SPDX-License-Identifier: Apache-2.0
"""A node, a server in front of it, and ways to talk to the server. Everything that is started here is ended here."""

import http.client
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import traceback

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from processes import cpu_seconds  # noqa: E402

TOKEN = "the-token-of-these-tests-0123456789"
DEADLINE_S = 60


def wait_for(condition, what):
    """The condition's first true value."""
    end = time.monotonic() + DEADLINE_S
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.02)
    raise AssertionError(f"waited in vain for {what}")


class Setting:
    """A folder, nodes and servers of one test program."""

    def __init__(self, programs, fake_node):
        self.programs, self.fake_node = pathlib.Path(programs), fake_node
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="serve_test_"))
        self.environment = dict(os.environ, INDUROP_STATE_DIR=str(self.folder / "state"))
        self.environment.pop("INDUROP_NODE", None)
        self.node = f"serve_{os.getpid()}"
        self.children = []
        self.tokens = self.folder / "tokens"
        self.tokens.write_text(f"ana {TOKEN}\n")
        self.tokens.chmod(0o600)

    def start(self, *command, **more):
        child = subprocess.Popen([str(word) for word in command], env=self.environment, stdout=subprocess.PIPE,
                                 text=True, **more)
        self.children.append(child)
        return child

    def start_node(self, *options):
        child = self.start(self.fake_node, self.node, *options)
        assert child.stdout.readline() == "ready\n"
        return child

    def start_server(self, *options, node=None):
        child = self.start(self.programs / "indurop-serve", "--node", node or self.node, "--port", 0, *options)
        line = child.stdout.readline()
        found = re.match(r"https?://[^/]*:(\d+)/", line)
        assert found, f"no address in '{line}'"
        server = Server(int(found.group(1)), child)
        server.line = line
        return server

    def end(self, child, how=signal.SIGTERM):
        if child.poll() is None:
            child.send_signal(how)
        child.wait(DEADLINE_S)
        if child in self.children:
            self.children.remove(child)
        return child.returncode

    def clean(self):
        for child in list(self.children):
            self.end(child, signal.SIGKILL)
        for file in pathlib.Path("/dev/shm").glob(f"*{self.node}*"):
            file.unlink(missing_ok=True)
        shutil.rmtree(self.folder)


class Answer:
    def __init__(self, status, headers, body):
        self.status, self.headers, self.body = status, headers, body

    def json(self):
        return json.loads(self.body)


class Server:
    def __init__(self, port, child):
        self.port, self.child, self.line = port, child, ""

    def ask(self, method, path, body=None, token=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=DEADLINE_S)
        sent = {name.replace("_", "-"): value for name, value in headers.items()}
        if token:
            sent["Authorization"] = "Bearer " + token
        if body is not None:
            sent.setdefault("Content-Type", "application/json")
            body = body if isinstance(body, (str, bytes)) else json.dumps(body)
        try:
            connection.request(method, path, body, sent)
            answer = connection.getresponse()
            return Answer(answer.status, dict(answer.getheaders()), answer.read())
        finally:
            connection.close()

    def get(self, path, **headers):
        return self.ask("GET", path, **headers)

    def post(self, path, body=None, token=TOKEN, **headers):
        return self.ask("POST", path, body, token, **headers)

    def raw(self, data, timeout=DEADLINE_S):
        """Sends bytes and returns all that comes until the server closes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=timeout) as connection:
            connection.sendall(data)
            connection.shutdown(socket.SHUT_WR)
            received = b""
            while (part := connection.recv(65536)):
                received += part
            return received

    def cpu_seconds(self):
        return cpu_seconds(self.child.pid)


def main(tests):
    """Runs functions of `tests` that begin with test_, or those that are named on the command line."""
    programs, fake_node, *names = sys.argv[1:]
    failed = []
    for name, test in list(tests.items()):
        if not name.startswith("test_") or (names and name not in names):
            continue
        setting = Setting(programs, fake_node)
        begin = time.monotonic()
        try:
            test(setting)
            print(f"ok      {name} ({time.monotonic() - begin:.1f} s)", flush=True)
        except Exception:  # the next test is run all the same
            failed.append(name)
            print(f"FAILED  {name}", flush=True)
            traceback.print_exc(file=sys.stdout)
        finally:
            setting.clean()
    sys.exit(f"failed: {', '.join(failed)}" if failed else 0)
