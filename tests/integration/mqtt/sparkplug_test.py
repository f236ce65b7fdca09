#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop-mqtt as an edge node of Sparkplug B: what it publishes is read, and what a host sends is written, by npm's
sparkplug-payload. sparkplug_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import time

from mqtt_harness import API, HERE, TOKEN, main, skip, wait_for
from npm_packages import fetch

GROUP = "spBv1.0/plant"


class Judge:
    """npm's sparkplug-payload."""

    def __init__(self, setting):
        self.child = setting.start("node", HERE / "decode.mjs", os.environ["MQTT_JUDGES"], stdin=subprocess.PIPE)

    def ask(self, **words):
        self.child.stdin.write(json.dumps(words) + "\n")
        self.child.stdin.flush()
        return json.loads(self.child.stdout.readline())

    def read(self, payload):
        return self.ask(hex=payload.hex())

    def write(self, *metrics):
        return bytes.fromhex(self.ask(payload={"timestamp": int(time.time() * 1000), "metrics": list(metrics)})["hex"])


class Host:
    """Reads everything that the edge node publishes, in order."""

    def __init__(self, setting, judge):
        self.judge, self.done, self.read = judge, 0, []
        self.client = setting.subscribe("spBv1.0/#")
        wait_for(lambda: setting.publish("spBv1.0/ready", "x") or self.client.last("spBv1.0/ready"), "the subscription")

    def messages(self, kind=None):
        for topic, payload, _ in self.client.all()[self.done:]:
            self.done += 1
            if topic.startswith(GROUP) and "CMD/" not in topic:
                self.read.append((topic.removeprefix(GROUP + "/"), self.judge.read(payload)))
        return [payload for topic, payload in self.read if kind is None or topic.startswith(kind + "/")]

    def wait(self, kind, condition, what):
        return wait_for(lambda: next((one for one in reversed(self.messages(kind)) if condition(one)), None), what)

    def wait_birth(self, count=1):
        return wait_for(lambda: len(births := self.messages("DBIRTH")) >= count and births[-1], "the birth of the board")

    def values(self, name):
        """All values of a metric since the last birth of the board, by name or alias, with their times."""
        alias = next(one["alias"] for one in self.messages("DBIRTH")[-1]["metrics"] if one["name"] == name)
        return [(one["value"], one["timestamp"], one.get("isHistorical", False)) for payload in self.messages("DDATA")
                for one in payload["metrics"] if one.get("name") == name or one.get("alias") == alias]


def metrics_of(payload):
    return {one.get("name"): one for one in payload["metrics"]}


def begin(setting, *options):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    setting.start_broker()
    host = Host(setting, Judge(setting))
    setting.door_options = ["--sparkplug", "plant", "--edge-node", "edge", "--no-plain", *options]
    setting.door = setting.start_door(server, *setting.door_options)
    return server, host


def restart_broker(setting, judge):
    """A new broker with a host that hears everything from the beginning."""
    setting.door.send_signal(signal.SIGSTOP)
    setting.start_broker()
    host = Host(setting, judge)
    setting.door.send_signal(signal.SIGCONT)
    return host


def request_rebirth(setting, host):
    setting.publish("spBv1.0/plant/NCMD/edge", host.judge.write({"name": "Node Control/Rebirth", "type": "Boolean", "value": True}))


def set_gain(setting, server, value):
    answer = server.post(f"{API}/boards/{setting.node}/set", {"values": {"gain": value}})
    assert answer.status == 200, answer.body


def test_births_describe_what_the_server_has(setting):
    server, host = begin(setting)
    birth = host.wait_birth()
    node = host.messages("NBIRTH")[-1]
    assert node["seq"] == 0 and birth["seq"] == 1, (node, birth)
    assert metrics_of(node)["bdSeq"]["type"] == "Int64" and metrics_of(node)["Node Control/Rebirth"]["value"] is False
    metrics = metrics_of(birth)
    variables = {one["name"]: one for one in server.get(f"{API}/boards/{setting.node}/variables").json()["variables"]}
    assert len(metrics) == len(variables) - 1 + 30, metrics.keys()  # joints has 30 numbers
    gain = metrics["knu/Robot/gain"]
    assert (gain["type"], gain["value"]) == ("Double", 1), gain
    assert gain["properties"]["engUnit"]["value"] == "mm" and gain["properties"]["Quality"]["value"] == 192, gain
    assert metrics["knu/Robot/joints[1]/y"]["type"] == "Double"
    assert metrics["knu/Robot/tick"]["type"] == "UInt32" and metrics["knu/Robot/mode"]["type"] == "Int32"
    assert (metrics["station/name"]["type"], metrics["station/starts"]["value"]) == ("String", variables["station::starts"]["value"])
    assert metrics["press/door_open"]["type"] == "Boolean"
    assert len({one["alias"] for one in birth["metrics"]}) == len(birth["metrics"])
    ticks = wait_for(lambda: len(all := host.values("knu/Robot/tick")) > 10 and all, "data")
    assert [one[0] for one in ticks] == sorted(one[0] for one in ticks) and [one[1] for one in ticks] == sorted(one[1] for one in ticks)
    sequence = [payload["seq"] for topic, payload in host.read if "DEATH/edge" not in topic]
    assert sequence == [i % 256 for i in range(len(sequence))], sequence


def test_deaths_have_the_number_of_their_birth(setting):
    server, host = begin(setting)
    number_of = lambda message: metrics_of(message)["bdSeq"]["value"]
    # On a busy machine the broker may lose and regain a connection, which has a number, too.
    newest = lambda kind, least: wait_for(lambda: next((one for one in reversed(host.messages(kind)) if number_of(one) >= least), None), kind)
    number = number_of(newest("NBIRTH", 0))
    for how in (signal.SIGKILL, signal.SIGTERM, signal.SIGKILL):
        setting.end(setting.door, how)
        assert metrics_of(newest("NDEATH", number)).keys() == {"bdSeq"}
        setting.door = setting.start_door(server, *setting.door_options)
        number = number_of(newest("NBIRTH", number + 1))
    setting.end(setting.broker, signal.SIGKILL)  # a connection of its own has a number of its own
    host = restart_broker(setting, host.judge)
    host.wait_birth()
    assert metrics_of(host.messages("NBIRTH")[-1])["bdSeq"]["value"] > number


def test_a_host_that_comes_late_requests_a_rebirth(setting):
    server, first = begin(setting)
    first.wait_birth()
    late = Host(setting, first.judge)
    birth = wait_for(lambda: request_rebirth(setting, late) or late.messages("NBIRTH"), "a rebirth")[0]
    assert birth["seq"] == 0 and metrics_of(birth)["bdSeq"]["value"] == 0, birth
    assert metrics_of(late.wait_birth())["knu/Robot/gain"]["value"] == 1


def test_boards_die_and_come_back(setting):
    _, host = begin(setting)
    host.wait_birth()
    board = next(child for child in setting.children if child.args[0] == str(setting.fake_node))
    setting.end(board, signal.SIGKILL)
    wait_for(lambda: host.messages("DDEATH"), "the death of the board")
    setting.start_node()
    host.wait_birth(2)
    assert not host.messages("NDEATH")


def test_commands_are_written_by_role(setting):
    ben = TOKEN[::-1]
    setting.tokens.write_text(f"ana {TOKEN} operate\nben {ben} look\n")
    server, host = begin(setting, "--token-file", setting.tokens, "--commander", "ana")
    birth = metrics_of(host.wait_birth())
    topic = f"spBv1.0/plant/DCMD/edge/{setting.node}"
    write = host.judge.write
    setting.publish(topic, write({"name": "knu/Robot/gain", "type": "Double", "value": 4.5}, {"name": "knu/Robot/mode", "type": "Int32", "value": 2}))
    wait_for(lambda: any(one[0] == 4.5 for one in host.values("knu/Robot/gain")), "the value")
    assert wait_for(lambda: host.values("knu/Robot/mode"), "the mode")[-1][0] == 2
    by_alias = {"alias": birth["knu/Robot/joints[1]/y"]["alias"], "type": "Double", "value": -45}
    setting.publish(topic, write(by_alias))
    wait_for(lambda: any(one[0] == -45 for one in host.values("knu/Robot/joints[1]/y")), "the value by its alias")
    before = len(host.values("knu/Robot/joints[1]/y"))
    setting.publish(topic, write({"name": "knu/Robot/joints[1]/y", "type": "Double", "value": 190}))  # beyond its range
    setting.log_has("190 is outside -180..180")
    wait_for(lambda: len(host.values("knu/Robot/joints[1]/y")) > before, "the old value again")
    assert host.values("knu/Robot/joints[1]/y")[-1][0] == -45
    audit = [one for one in server.get(API + "/audit").json()["audit"] if one["outcome"] == "done"]
    assert [(one["who"], one["reason"]) for one in audit] == [("ana", "Sparkplug")] * 2, audit
    setting.end(setting.door)
    setting.log.write_text("")
    setting.door = setting.start_door(server, *setting.door_options[:-1], "ben")
    host.wait_birth(2)
    setting.publish(topic, write({"name": "knu/Robot/gain", "type": "Double", "value": 9}))
    setting.log_has("is refused: ")
    assert server.get(f"{API}/boards/{setting.node}/variables/gain").json()["value"] == 4.5
    setting.end(setting.door)
    setting.log.write_text("")
    setting.door = setting.start_door(server, "--sparkplug", "plant", "--edge-node", "edge", "--no-plain")
    host.wait_birth(3)
    setting.publish(topic, write({"name": "knu/Robot/gain", "type": "Double", "value": 9}))
    setting.log_has("is refused: no user")
    assert server.get(f"{API}/boards/{setting.node}/variables/gain").json()["value"] == 4.5


def contents(folder):
    """Of all files. indurop-mqtt may remove one meanwhile."""
    for file in folder.glob("*"):
        try:
            yield file.read_bytes()
        except FileNotFoundError:
            pass


def test_nothing_is_lost_while_the_broker_is_away(setting):
    """Neither by the end of the broker, nor by ends of indurop-mqtt while it is away."""
    server, host = begin(setting, "--variables", "gain")
    host.wait_birth()
    set_gain(setting, server, 2)
    wait_for(lambda: 2 in [one[0] for one in host.values("knu/Robot/gain")], "a value")
    setting.end(setting.broker, signal.SIGKILL)
    setting.log_has("was lost")
    store = setting.folder / "mqtt" / "store"
    kept = lambda: sum(len(content) for content in contents(store))
    is_kept = lambda value: any(struct.pack("<d", value) in content for content in contents(store))
    values = [round(3 + i / 10, 1) for i in range(30)]
    for i, value in enumerate(values):
        set_gain(setting, server, value)
        wait_for(lambda: is_kept(value), "the value to be kept")
        if i % 10 == 9:
            setting.end(setting.door, signal.SIGKILL)
            before = kept()
            setting.door = setting.start_door(server, *setting.door_options)
            wait_for(lambda: kept() > before, "its present value to be kept")
    host = restart_broker(setting, host.judge)
    host.wait_birth()
    wait_for(lambda: kept() == 0, "everything to be confirmed")
    everything = [one for one in host.values("knu/Robot/gain") if one[2]]
    once = list(dict.fromkeys(value for value, _, _ in everything if value > 2))  # the last before the end may come again
    assert once == values, (once, everything)
    assert [one[1] for one in everything] == sorted(one[1] for one in everything)


def test_nothing_is_lost_by_a_broker_that_hangs(setting):
    """What was sent to it, but not received, is sent again."""
    server, host = begin(setting, "--variables", "gain")
    host.wait_birth()
    set_gain(setting, server, 2)
    wait_for(lambda: 2 in [one[0] for one in host.values("knu/Robot/gain")], "a value")
    setting.broker.send_signal(signal.SIGSTOP)
    values = [3.5, 4.5, 5.5]
    for value in values:
        set_gain(setting, server, value)
        stream = f"{API}/boards/{setting.node}/variables/gain"
        before = server.get(API + "/status").json()["clients"][0]["sent"]
        wait_for(lambda: server.get(API + "/status").json()["clients"][0]["sent"] > before + 3, "the value to be sent on")
        assert server.get(stream).json()["value"] == value
    setting.end(setting.broker, signal.SIGKILL)
    setting.log_has("was lost")
    host = restart_broker(setting, host.judge)
    host.wait_birth()
    wait_for(lambda: [one for one, _, historical in host.values("knu/Robot/gain") if historical and one > 2] == values, "all values")


def test_data_are_kept_for_the_primary_host(setting):
    server, host = begin(setting, "--variables", "gain", "--primary-host", "scada")
    kept = lambda: sum(len(content) for content in contents(setting.folder / "mqtt" / "store"))
    wait_for(kept, "the first value to be kept")
    assert not host.messages("NBIRTH")
    setting.publish("spBv1.0/STATE/scada", json.dumps({"online": True, "timestamp": 1000}), "-r")
    host.wait_birth()
    wait_for(lambda: kept() == 0, "everything to be confirmed")
    setting.publish("spBv1.0/STATE/scada", json.dumps({"online": False, "timestamp": 1000}), "-r")
    wait_for(lambda: host.messages("NDEATH"), "its death")
    set_gain(setting, server, 5)
    wait_for(kept, "the value to be kept")
    setting.publish("spBv1.0/STATE/scada", json.dumps({"online": True, "timestamp": 2000}), "-r")
    host.wait_birth(2)
    wait_for(lambda: (5, True) in [(value, historical) for value, _, historical in host.values("knu/Robot/gain")], "what was kept")
    assert metrics_of(host.messages("NBIRTH")[-1])["bdSeq"]["value"] == 1


if __name__ == "__main__":
    if not shutil.which("npm") or not shutil.which("node"):
        skip("there is no npm here")
    fetch(HERE / "judges", pathlib.Path(os.environ["MQTT_JUDGES"]))
    main(globals())
