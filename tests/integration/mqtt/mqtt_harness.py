# SPDX-License-Identifier: Apache-2.0
"""A node, `indurop serve` before it, mosquitto, indurop-mqtt between them, and mosquitto's clients, which tests drive."""

import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import threading

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "serve"))
sys.path.insert(0, str(HERE.parents[1] / "support"))
import harness  # noqa: E402
from harness import DEADLINE_S, TOKEN, wait_for  # noqa: E402, F401
from npm_packages import skip  # noqa: E402
from processes import free_port  # noqa: E402

API = "/api/v1"
BROKER = shutil.which("mosquitto") or shutil.which("/usr/sbin/mosquitto")


class Subscriber:
    """mosquitto_sub: topics and payloads (bytes) in their order."""

    def __init__(self, setting, filters, *options):
        words = [word for filter in filters for word in ("-t", filter)]
        self.child = setting.start("mosquitto_sub", *setting.client_options(), "-q", "1", *options, *words, "-F", "%t %r %x")
        self.messages = []
        self.lock = threading.Lock()
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        for line in self.child.stdout:
            topic, retained, *payload = line.rstrip("\n").split(" ")
            with self.lock:
                self.messages.append((topic, bytes.fromhex(payload[0]) if payload else b"", retained == "1"))

    def all(self, topic=None):
        with self.lock:
            return [one for one in self.messages if topic is None or one[0] == topic]

    def last(self, topic):
        found = self.all(topic)
        return found[-1][1] if found else None

    def becomes(self, topic, condition, what):
        """The newest payload of a topic as JSON, once it is as wanted."""
        return wait_for(lambda: (text := self.last(topic)) and condition(one := json.loads(text)) and [one], what)[0]


class Setting(harness.Setting):
    def __init__(self, programs, fake_node):
        super().__init__(pathlib.Path(programs).absolute(), fake_node)
        self.log = self.folder / "mqtt.log"
        self.port = free_port()
        self.broker = None
        self.broker_lines = ["allow_anonymous true"]
        self.client = []  # further options of mosquitto's clients

    def client_options(self):
        return ["-h", "127.0.0.1", "-p", str(self.port), *self.client]

    def start_broker(self):
        config = self.folder / "mosquitto.conf"
        config.write_text("\n".join([f"listener {self.port} 127.0.0.1", "persistence false", "user root", *self.broker_lines]) + "\n")
        with (self.folder / "mosquitto.log").open("a") as log:
            self.broker = self.start(BROKER, "-c", config, stderr=log)
        wait_for(self.broker_listens, "the broker")
        return self.broker

    def broker_listens(self):
        with socket.socket() as one:
            return one.connect_ex(("127.0.0.1", self.port)) == 0

    def start_door(self, server, *options, scheme="mqtt", host="127.0.0.1", serve="http://127.0.0.1"):
        with self.log.open("a") as log:
            return self.start(self.programs / "indurop-mqtt", "--serve", f"{serve}:{server.port}", "--broker",
                              f"{scheme}://{host}:{self.port}", "--state", self.folder / "mqtt", *options, stderr=log)

    def subscribe(self, *filters, options=()):
        return Subscriber(self, filters, *options)

    def publish(self, topic, payload, *options):
        file = self.folder / "payload"
        file.write_bytes(payload if isinstance(payload, bytes) else payload.encode())
        subprocess.run(["mosquitto_pub", *self.client_options(), "-t", topic, "-f", file, *options], check=True, timeout=DEADLINE_S)

    def openssl(self, *words):
        subprocess.run(["openssl", *words], cwd=self.folder, check=True, capture_output=True)

    def make_authority(self, name):
        self.openssl("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout", f"{name}.key", "-out",
                     f"{name}.pem", "-subj", f"/CN={name}", "-days", "10")

    def make_certificate(self, name, authority, host):
        (self.folder / "names").write_text(f"subjectAltName={host}\n")
        self.openssl("req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout", f"{name}.key", "-out", f"{name}.csr",
                     "-subj", f"/CN={name}")
        self.openssl("x509", "-req", "-in", f"{name}.csr", "-out", f"{name}.pem", "-days", "10", "-CA", f"{authority}.pem", "-CAkey",
                     f"{authority}.key", "-CAcreateserial", "-extfile", "names")

    def log_has(self, text):
        return wait_for(lambda: text in self.log.read_text(), f"'{text}' in the log")

    def clean(self):
        if self.log.exists():
            print("".join(f"    {line}\n" for line in self.log.read_text().splitlines()), end="")
        super().clean()


def main(tests):
    if not BROKER or not shutil.which("mosquitto_sub"):
        skip("mosquitto or its clients are missing")
    os.environ["PATH"] += ":/usr/sbin"
    harness.Setting = Setting
    harness.main(tests)
