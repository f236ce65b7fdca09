#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Values of every kind over OPC UA, read by node-opcua's client and compared with what `indurop serve` says of them; quality,
forces, a board that stops and comes back with other variables. values_test.py PROGRAMS FAKE_NODE [TEST...]"""

import subprocess
import time

from opcua_harness import API, main, wait_for

GOOD = "Good"
SCALARS = {  # name: type, value as node-opcua's client shows it, 64 bits as high and low half
    "flag": ("Boolean", True), "tiny": ("SByte", -5), "byte": ("Byte", 200), "small": ("Int16", -30000), "word": ("UInt16", 60000),
    "whole": ("Int32", -2000000000), "natural": ("UInt32", 4000000000), "wide": ("Int64", [0xFFDFFFFF, 0xFFFFFFFD]),
    "huge": ("UInt64", [0xFFFFFFFF, 0xFFFFFFFF]), "single": ("Float", 0.5), "precise": ("Double", 2.25), "letter": ("Byte", ord("k")),
    "text": ("String", "hüt"), "mode": ("Int32", 2),
}


def begin(setting, *options):
    setting.start_real_node()
    server = setting.start_server(*options)
    return server, setting.client(setting.start_opcua(server, "--anonymous"))


def test_every_kind_is_read(setting):
    _, client = begin(setting)
    for name, (kind, value) in SCALARS.items():
        one = client.read(setting.id(f"every::{name}"))
        assert (one["code"], one["type"], one["value"]) == (GOOD, kind, value), (name, one)
    assert client.read(setting.id("every::numbers"))["value"] == [0, 0, 0, -7]
    assert client.read(setting.id("every::numbers"), range="2:3")["value"] == [0, -7]
    matrix = client.read(setting.id("every::matrix"))
    assert (matrix["value"], matrix["dims"]) == ([0, 0, 0, 0, 0, 12.5], [2, 3]), matrix
    point = client.read(setting.id("every::point"))
    assert point["type"] == "ExtensionObject", point
    assert point["value"] == {"x": 1.5, "y": 0, "valid": True, "name": "", "grid": [0, 2, 0, 0, 0, 6], "mode": 2}, point
    assert len(client.read(setting.id("every::points"))["value"]) == 2
    for part, value in (("x", 1.5), ("valid", True), ("grid", [0, 2, 0, 0, 0, 6]), ("mode", 2)):
        assert client.read(setting.id(f"every::point.{part}"))["value"] == value, part
    counted = [client.read(setting.id(f"every::points[1].{part}"))["value"] for part in ("y", "y")]
    assert 0 < counted[0] <= counted[1], counted
    assert "point_t.grid: 2 dimensions" in setting.log.read_text() or "Point.grid: 2 dimensions" in setting.log.read_text()


def test_the_tree_has_every_variable_with_its_type(setting):
    server, client = begin(setting)
    nodes = client.walk(f"ns=2;s={setting.node}")
    variables = server.get(f"{API}/boards/{setting.node}/variables").json()["variables"]
    assert len(variables) == 19, [one["name"] for one in variables]
    for one in variables:
        assert setting.id(one["name"]) in nodes, (one["name"], sorted(nodes))
    assert setting.id("every::points[1].grid") in nodes
    assert nodes[setting.id("every::point.x")]["type"] == "ns=0;i=2368", "AnalogItemType"
    unit = client.read(setting.id("every::point.x") + "/EngineeringUnits")["value"]
    assert unit["unitId"] == 0x4D4D54 and unit["namespaceUri"].endswith("cefact"), unit  # MMT
    assert client.read(setting.id("every::point.x") + "/EURange")["value"] == {"low": -10, "high": 10}
    unit = client.read(setting.id("every::single") + "/EngineeringUnits")["value"]
    assert unit["unitId"] == 0x43454C, unit  # CEL
    assert client.read(setting.id("every::precise") + "/EngineeringUnits")["value"]["unitId"] == -1, "no code for this unit"
    kind = client.read(setting.id("every::mode"), attribute="DataType")["value"]
    names = client.read(kind + "/EnumValues")["value"]
    assert [one["displayName"] for one in names] == ["OFF", "AUTO", "MANUAL"], names
    structure = client.read(client.read(setting.id("every::point"), attribute="DataType")["value"], attribute="DataTypeDefinition")
    assert [field["name"] for field in structure["value"]["fields"]] == ["x", "y", "valid", "name", "grid", "mode"], structure


def test_changes_are_reported_as_the_stream_has_them(setting):
    _, client = begin(setting)
    count, part, flag = (setting.id(f"every::{name}") for name in ("count", "points[1].y", "flag"))
    assert client.do("monitor", nodes=[count, part, flag]) == [GOOD] * 3
    first = client.becomes(part, lambda one: one["value"], "a first value")
    later = client.becomes(part, lambda one: one["value"] > first["value"] + 200, "a later value")
    assert later["source"] > first["source"] and abs(later["source"] / 1000 - time.time()) < 60
    assert abs(later["server"] - later["source"]) < 60_000
    assert client.do("changes")[flag]["count"] == 1, "what does not change is reported once"
    slow = setting.id("every::points")
    client.do("monitor", nodes=[slow], interval=2000)
    client.becomes(slow, lambda one: one["value"], "a first value")
    seen = client.do("changes")
    client.becomes(slow, lambda one: one["count"] >= seen[slow]["count"] + 2, "two intervals")
    now = client.do("changes")
    assert now[count]["count"] - seen[count]["count"] > 2 * (now[slow]["count"] - seen[slow]["count"]), (seen, now)


def test_what_no_client_wants_is_not_received(setting):
    server, client = begin(setting)
    streams = lambda: sum(one["streams"] for one in server.get(f"{API}/status").json()["clients"])
    assert streams() == 0
    node = setting.id("every::flag")
    client.do("monitor", nodes=[node])
    client.becomes(node, lambda one: one["code"] == GOOD, "a value")
    assert streams() == 1
    client.do("unmonitor", nodes=[node])
    wait_for(lambda: streams() == 0, "the subscription to end")


def test_quality(setting):
    node = setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    client = setting.client(setting.start_opcua(server, "--anonymous"))
    gain = setting.id("knu::Robot::gain")
    client.do("monitor", nodes=[gain])
    client.becomes(gain, lambda one: one["code"] == GOOD, "good")
    forces = f"{API}/boards/{setting.node}"
    assert server.post(f"{forces}/force", {"values": {"gain": 7.5}}).status == 200
    held = client.becomes(gain, lambda one: one["code"] == "GoodLocalOverride", "the force")
    assert held["value"] == 7.5 and client.read(gain)["code"] == "GoodLocalOverride"
    assert server.post(f"{forces}/release", {"all": True}).status == 200
    client.becomes(gain, lambda one: one["code"] == GOOD, "good again")
    setting.end(node)
    client.becomes(gain, lambda one: one["code"] == "BadOutOfService", "the node to be stopped")
    setting.start_node()
    client.becomes(gain, lambda one: one["code"] == GOOD, "the node to be back")
    setting.end(server.child)
    client.becomes(gain, lambda one: one["code"] == "BadNoCommunication", "the server to be lost")
    assert client.read(gain)["code"] == "BadNoCommunication"
    port = server.port
    again = setting.start(setting.programs / "indurop-serve", "--node", setting.node, "--port", port)
    assert again.stdout.readline()
    client.becomes(gain, lambda one: one["code"] == GOOD, "the server to be back")


def test_a_deployment_ends_no_subscription(setting):
    node = setting.start_node("many", "3")
    server = setting.start_server()
    client = setting.client(setting.start_opcua(server, "--anonymous"))
    tick, gone = setting.id("knu::Robot::tick"), setting.id("many::v2")
    client.do("monitor", nodes=[tick, gone])
    client.becomes(gone, lambda one: one["code"] == GOOD, "a value")
    first = client.becomes(tick, lambda one: one["code"] == GOOD, "a value")
    setting.end(node)
    node = setting.start_node("many", "1")
    client.becomes(gone, lambda one: one["code"] == "BadNodeIdUnknown", "the variable to be gone")
    assert client.read(gone)["code"] == "BadNodeIdUnknown"
    assert gone not in client.walk(f"ns=2;s={setting.node}") and setting.id("many::v0") in client.walk(f"ns=2;s={setting.node}")
    client.becomes(tick, lambda one: one["code"] == GOOD and one["count"] > first["count"] + 3, "values to go on")
    setting.end(node)
    setting.start_node("many", "3")
    client.becomes(gone, lambda one: one["code"] == GOOD and one["value"], "the variable to be back")
    assert gone in client.walk(f"ns=2;s={setting.node}")


def test_another_type_takes_the_place_of_one(setting):
    setting.start_node()
    server = setting.start_server()
    client = setting.client(setting.start_opcua(server, "--anonymous"))
    tick = setting.id("knu::Robot::tick")
    client.do("monitor", nodes=[tick])
    client.becomes(tick, lambda one: one["code"] == GOOD, "a value")
    setting.end(setting.children[0])
    setting.start_real_node()
    client.becomes(tick, lambda one: one["code"] == "BadNodeIdUnknown", "the variable to be gone")
    assert client.read(setting.id("every::flag"))["value"] is True
    setting.end(setting.children[-1])
    setting.start_node()
    client.becomes(tick, lambda one: one["code"] == GOOD, "the variable to be back")
    client.do("unmonitor", nodes=[tick])


def test_check_lists_what_is_shown(setting):
    setting.start_real_node()
    server = setting.start_server()
    done = subprocess.run(["node", setting.programs / "indurop-opcua", "--serve", f"http://127.0.0.1:{server.port}", "--check",
                           "--state", setting.folder / "opcua"], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("1 boards, ") and "2 dimensions" in done.stderr, done


if __name__ == "__main__":
    main(globals())
