#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop stream as a program that draws receives it. stream_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import pathlib
import socket
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "serve"))
import harness  # noqa: E402


def receiver():
    listening = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
    listening.bind(("127.0.0.1", 0))
    listening.settimeout(harness.DEADLINE_S)
    return listening


def stream(setting, *words):
    return subprocess.run([setting.programs / "indurop", "stream", "--node", setting.node, *words], env=setting.environment,
                          capture_output=True, text=True, timeout=60, check=False)


def test_sends_json_as_plotjuggler_takes_it(setting):
    setting.start_node()
    listening = receiver()
    done = stream(setting, "knu::*", "station::name", "joints[1].y", "--plotjuggler", "--to",
                  f"127.0.0.1:{listening.getsockname()[1]}", "--hz", "100", "-n", "5")
    assert done.returncode == 0, done.stderr
    messages = [json.loads(listening.recv(65536)) for _ in range(5)]
    times = [one["timestamp"] for one in messages]
    assert times == sorted(times) and abs(times[0] - time.time()) < 60
    robot = messages[0]["knu"]["Robot"]
    assert robot["gain"] == 1 and robot["mode"] == "OFF" and len(robot["joints"]) == 10, robot
    assert robot["joints[1].y"] == robot["joints"][1]["y"] and messages[0]["station"]["name"] == ""
    assert messages[4]["knu"]["Robot"]["tick"] > messages[0]["knu"]["Robot"]["tick"]


def test_many_values_come_in_several_datagrams(setting):
    setting.start_node("many", "5000")
    listening = receiver()
    assert stream(setting, "many::*", "--plotjuggler", "--to", f"127.0.0.1:{listening.getsockname()[1]}",
                  "-n", "1").returncode == 0
    seen = {}
    while len(seen) < 5000:
        data = listening.recv(65536)
        assert len(data) < 65507
        seen.update(json.loads(data)["many"])
    assert set(seen) == {f"v{i}" for i in range(5000)}


def test_says_what_is_wrong(setting):
    setting.start_node()
    assert stream(setting, "tick").returncode == 2
    assert stream(setting, "tick", "--plotjuggler", "--to", "nonsense").returncode == 2
    assert stream(setting, "missing", "--plotjuggler").returncode == 1
    done = stream(setting, "tick", "--plotjuggler", "--to", "127.0.0.1:9", "-n", "3", "--hz", "100")
    assert done.returncode == 0, done  # no server listens there


if __name__ == "__main__":
    harness.main(globals())
