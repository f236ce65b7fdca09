#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Alarms as clients of indurop-serve and the command line meet them. alarms_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import signal
import subprocess

import harness
from harness import wait_for
from websocket import WebSocket

API = "/api/v1"
OIL = "press::oil > 80"


class Press:
    """The fake node's oil and door, a server, and the verb."""

    def __init__(self, setting):
        self.setting = setting
        setting.start_node()
        self.server = self.serve()
        self.base = f"{API}/boards/{setting.node}"

    def serve(self):
        return self.setting.start_server("--write", "--token-file", self.setting.tokens)

    def run(self, *words, code=0):
        done = subprocess.run([self.setting.programs / "indurop", *words, "--node", self.setting.node],
                              env=self.setting.environment, capture_output=True, text=True, timeout=60)
        assert done.returncode == code, (words, done)
        return done

    def set(self, name, value):
        self.run("set", name, str(value))

    def list(self, more=""):
        return {one["alarm"]: one for one in self.server.get(f"{self.base}/alarms{more}").json()["alarms"]}

    def becomes(self, alarm, state):
        return wait_for(lambda: (one := self.list("?all=true").get(alarm)) and one["state"] == state and one,
                        f"{alarm} {state}")

    def events(self):
        return [(one["event"], one["alarm"]) for one in
                self.server.get(f"{self.base}/alarms/history").json()["events"]]

    def order(self, what, **body):
        return self.server.post(f"{self.base}/alarms/{what}", body)


def test_an_alarm_comes_is_acknowledged_and_goes(setting):
    press = Press(setting)
    wait_for(lambda: press.server.get(press.base + "/alarms").json()["watched"], "a process that evaluates alarms")
    assert press.list() == {} and set(press.list("?all=true")) == {OIL, "press::door_open"}
    client = WebSocket(press.server.port)
    press.set("press::oil", 91.5)
    word = client.heard("alarms")
    while word["unacknowledged"] != 1:
        word = client.heard("alarms")
    assert word["board"] == setting.node and word["active"] == 1 and word["worst"] == "high"
    one = press.becomes(OIL, "unacknowledged")
    assert one["value"] == "91.5" and one["text"] == "the oil is too hot" and one["unit"] == "degC", one
    summary = press.server.get(API + "/boards").json()["boards"][0]
    assert summary["alarms"]["unacknowledged"] == 1 and any("not acknowledged" in text for text in summary["trouble"])
    assert press.order("ack", alarms=[OIL], reason="cooling is on").json()["alarms"] == [OIL]
    one = press.becomes(OIL, "acknowledged")
    assert one["who"] == "ana" and one["reason"] == "cooling is on"
    press.set("press::oil", 78)  # within the deadband
    press.set("press::door_open", True)
    press.becomes("press::door_open", "unacknowledged")
    assert press.list()[OIL]["state"] == "acknowledged"
    press.set("press::oil", 70)
    press.becomes(OIL, "normal")
    assert press.events() == [("raised", OIL), ("acknowledged", OIL), ("raised", "press::door_open"), ("cleared", OIL)]
    audit = press.server.get(API + "/audit").json()["audit"]
    assert [(one["action"], one["what"], one["outcome"]) for one in audit if one["who"] == "ana"] == [
        ("acknowledge", OIL, "begun"), ("acknowledge", OIL, "done")], audit
    client.close()


def test_one_that_went_unseen_stays_until_it_is_acknowledged(setting):
    press = Press(setting)
    press.set("press::door_open", True)
    press.becomes("press::door_open", "unacknowledged")
    press.set("press::door_open", False)
    press.becomes("press::door_open", "returned")
    press.set("press::door_open", True)
    assert press.becomes("press::door_open", "unacknowledged")["count"] == 2
    press.set("press::door_open", False)
    press.becomes("press::door_open", "returned")
    assert press.order("ack", all=True).json()["alarms"] == ["press::door_open"]
    press.becomes("press::door_open", "normal")


def test_a_shelved_one_is_quiet_for_its_time(setting):
    press = Press(setting)
    press.set("press::oil", 95)
    press.becomes(OIL, "unacknowledged")
    assert press.order("shelve", alarms=["oil"], for_ns=3600 * 10**9, reason="sensor").json()["alarms"] == [OIL]
    one = press.becomes(OIL, "shelved")
    assert one["until_wall_ns"] > one["since_wall_ns"] and one["reason"] == "sensor"
    assert press.server.get(press.base + "/alarms").json()["counts"]["worst"] is None
    assert press.order("unshelve", alarms=[OIL]).status == 200
    press.becomes(OIL, "unacknowledged")
    press.order("shelve", alarms=[OIL], for_ns=1)
    press.becomes(OIL, "unacknowledged")
    assert press.events()[-2:] == [("unshelved", OIL), ("raised", OIL)]


def test_a_killed_server_forgets_nothing(setting):
    press = Press(setting)
    press.set("press::oil", 95)
    press.set("press::door_open", True)
    press.becomes(OIL, "unacknowledged")
    press.becomes("press::door_open", "unacknowledged")
    press.order("ack", alarms=[OIL])
    before = press.events()
    setting.end(press.server.child, signal.SIGKILL)
    press.server = press.serve()
    assert press.list()[OIL]["state"] == "acknowledged"
    assert press.list()["press::door_open"]["state"] == "unacknowledged"
    press.set("press::door_open", False)
    press.becomes("press::door_open", "returned")
    assert press.events() == before + [("cleared", "press::door_open")]


def test_a_dead_node_leaves_its_alarms_as_they_are(setting):
    press = Press(setting)
    press.set("press::oil", 95)
    press.becomes(OIL, "unacknowledged")
    node = setting.children[0]
    setting.end(node, signal.SIGKILL)
    wait_for(lambda: not press.server.get(API + "/boards").json()["boards"][0]["alive"], "the node to be missed")
    assert press.list()[OIL]["state"] == "unacknowledged"
    assert press.order("ack", alarms=[OIL]).status == 200
    press.becomes(OIL, "acknowledged")


def test_of_two_servers_one_looks_and_the_other_takes_over(setting):
    press = Press(setting)
    first = press.server
    press.set("press::oil", 95)
    press.becomes(OIL, "unacknowledged")
    second = press.serve()
    press.server = second
    press.becomes(OIL, "unacknowledged")
    press.set("press::door_open", True)
    press.becomes("press::door_open", "unacknowledged")
    assert press.events() == [("raised", OIL), ("raised", "press::door_open")]
    setting.end(first.child, signal.SIGKILL)
    press.set("press::door_open", False)
    press.becomes("press::door_open", "returned")


def test_the_command_line_and_the_server_see_the_same(setting):
    press = Press(setting)
    press.set("press::oil", 95)
    press.becomes(OIL, "unacknowledged")
    shown = json.loads(press.run("alarms", "-o", "json").stdout)
    assert shown["watched"] and [one["alarm"] for one in shown["alarms"]] == [OIL], shown
    assert "1 alarm is active, 1 is not acknowledged" in press.run("status").stdout
    assert "high alarm, unacknowledged: the oil is too hot" in press.run("top").stdout
    assert press.run("alarms", "ack", "oil", "--reason", "seen").stdout == f"acknowledged {OIL}\n"
    press.becomes(OIL, "acknowledged")
    assert "seen" in press.run("alarms", "history", "-o", "csv").stdout
    assert "did you mean" in press.run("alarms", "ack", "press::oli", code=1).stderr
    press.run("alarms", "ack", code=2)
    press.run("alarms", "shelve", "press::*", "--for", "1h")
    press.becomes("press::door_open", "shelved")
    setting.end(press.server.child)
    assert "no process is evaluating the alarms" in press.run("alarms").stderr


def test_a_module_that_is_stopped_is_an_alarm(setting):
    example = setting.programs.parent / "examples" / "plc" / "module.xml"
    setting.start(setting.programs / "indurop", "run", example, "-q", "--node", setting.node)
    ask = [setting.programs / "indurop", "status", "--check", "--node", setting.node]
    code = lambda: subprocess.run(ask, env=setting.environment, capture_output=True, check=False).returncode
    wait_for(lambda: code() == 0, "the node")
    server = setting.start_server("--write", "--token-file", setting.tokens)
    base = f"{API}/boards/{setting.node}"
    alarms = lambda: {one["alarm"]: one for one in server.get(f"{base}/alarms").json()["alarms"]}
    summary = lambda: server.get(f"{API}/boards").json()["boards"][0]
    assert not any("is stopped" in text for text in summary()["trouble"]) and alarms() == {}
    assert server.post(f"{base}/modules/conveyor/stop", {}).status == 200
    assert summary()["trouble"][0] == "module conveyor is stopped"
    assert code() == 4
    one = wait_for(lambda: alarms().get("module conveyor"), "the alarm")
    assert (one["state"], one["priority"], one["text"]) == ("unacknowledged", "high", "module conveyor is stopped"), one
    # The list is written before its figures.
    wait_for(lambda: "1 alarm is active, 1 is not acknowledged" in summary()["trouble"], "the alarm among the troubles")
    assert server.post(f"{base}/alarms/shelve", {"alarms": ["module conveyor"], "for_ns": 1}).status == 200
    wait_for(lambda: alarms().get("module conveyor", {}).get("count") == 2, "the alarm after it was shelved")
    assert server.post(f"{base}/modules/conveyor/start", {}).status == 200
    wait_for(lambda: alarms()["module conveyor"]["state"] == "returned", "the end of the alarm")
    assert code() == 4  # it is not acknowledged
    assert server.post(f"{base}/alarms/ack", {"all": True}).json()["alarms"] == ["module conveyor"]
    wait_for(lambda: code() == 0 and alarms() == {}, "that all is well")


def test_a_stop_needs_no_log(setting):
    example = setting.programs.parent / "examples" / "plc" / "module.xml"
    setting.start(setting.programs / "indurop", "run", example, "-q", "--node", setting.node)
    ask = [setting.programs / "indurop", "status", "--check", "--node", setting.node]
    wait_for(lambda: subprocess.run(ask, env=setting.environment, capture_output=True, check=False).returncode == 0, "the node")
    server = setting.start_server("--write", "--token-file", setting.tokens, "--audit", "/proc/nowhere/audit.jsonl")
    module = f"{API}/boards/{setting.node}/modules/conveyor"
    assert server.post(module + "/restart", {}).status == 500
    stopped = server.post(module + "/stop", {})
    assert stopped.status == 200 and "/proc/nowhere/audit.jsonl" in stopped.json()["not_logged"], stopped.json()
    assert server.post(module + "/start", {}).status == 500


def test_orders_that_make_no_sense_change_nothing(setting):
    press = Press(setting)
    press.set("press::oil", 95)
    press.becomes(OIL, "unacknowledged")
    for body, code in (({}, 400), ({"alarms": [OIL], "all": True}, 400), ({"alarms": [OIL, "press::oli"]}, 422)):
        assert press.order("ack", **body).status == code, body
    assert press.order("shelve", alarms=[OIL]).status == 400
    assert press.server.post(f"{press.base}/alarms/ack", "[]").status == 400
    assert press.server.post(f"{press.base}/alarms/ack", {"all": True}, token=None).status == 401
    assert press.server.get(f"{press.base}/alarms/history?count=0").status == 400
    assert press.server.post(f"{API}/boards/none/alarms/ack", {"all": True}).status == 404
    assert press.list()[OIL]["state"] == "unacknowledged"


if __name__ == "__main__":
    harness.main(globals())
