#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Foxglove's protocol where it is not plain sailing: strangers, slow clients, nodes that go. foxglove_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import re
import struct

import harness
from harness import wait_for
from websocket import BINARY, TEXT, Closed, Refused, WebSocket

PROTOCOL = ("foxglove.websocket.v1",)


def connect(server, **more):
    return WebSocket(server.port, **{"protocols": PROTOCOL, "path": "/", **more})


def word(client, op):
    """The next word of this kind; what comes before it is passed over."""
    while True:
        opcode, data = client.frame()
        if opcode == TEXT and (heard := json.loads(data))["op"] == op:
            return heard


def values(client):
    """The next binary message: subscription, time, CDR."""
    while True:
        opcode, data = client.frame()
        if opcode == BINARY:
            kind, subscription, time_ns = struct.unpack_from("<BIQ", data)
            assert kind == 1
            return subscription, time_ns, data[13:]


def channels(client):
    return {one["topic"]: one["id"] for one in word(client, "advertise")["channels"]}


def test_shows_what_is_asked_for_at_its_rate(setting):
    setting.start_node()
    server = setting.start_server("--foxglove", "tick", "--foxglove", "joints[0].x", "--foxglove", "knu::*", "--foxglove-hz", "20")
    client = connect(server)
    known = channels(client)
    assert "knu::Robot::joints[0].x" in known and "station::name" not in known and len(known) == 5, known
    client.say(op="subscribe", subscriptions=[{"id": 7, "channelId": known["knu::Robot::tick"]}])
    times = [values(client)[1] for _ in range(12)]
    # Each but the first belongs to a 50 ms of its own, whenever in them it was taken.
    assert times[-1] - times[1] > 9 * 50_000_000, times
    client.close()


def test_subscriptions_that_cannot_be_are_refused_in_words(setting):
    setting.start_node()
    client = connect(setting.start_server())
    known = channels(client)
    tick = known["knu::Robot::tick"]
    client.say(op="subscribe", subscriptions=[{"id": 1, "channelId": tick}, {"id": 1, "channelId": known["knu::Robot::gain"]},
                                              {"id": 2, "channelId": tick}, {"id": 3, "channelId": 99999}, {"id": -1}, "nonsense"])
    assert "there is one of this id" in word(client, "status")["message"]
    assert f"channel {tick} has one" in word(client, "status")["message"]
    assert {values(client)[0] for _ in range(10)} == {1}
    client.say(op="advertise", channels=[])
    assert "'advertise' is not served" in word(client, "status")["message"]
    client.send_frame(TEXT, b"no JSON")
    try:
        while True:
            client.frame()
    except Closed as closed:
        assert closed.code == 1007
    other = connect(setting.start_server())
    other.send_frame(BINARY, b"\x01abc")
    try:
        while True:
            other.frame()
    except Closed as closed:
        assert closed.code == 1003


def test_only_known_pages_may_follow(setting):
    setting.start_node()
    server = setting.start_server("--origin", "https://app.foxglove.dev")
    connect(server, origin="https://app.foxglove.dev").close()
    for origin in ("https://evil.example", "https://app.foxglove.dev.evil.example", "null"):
        try:
            connect(server, origin=origin)
            raise AssertionError(origin)
        except Refused as refused:
            assert refused.status == 403
    answer = server.get("/api/v1/status", Origin="https://app.foxglove.dev")
    assert answer.status == 403, "that is for streams only"


def test_a_client_that_never_reads_gets_the_number_of_lost_messages(setting):
    setting.start_node("many", "1000")
    server = setting.start_server("--foxglove-hz", "100")
    slow, quick = connect(server), connect(server)
    for client in (slow, quick):
        known = channels(client)
        client.say(op="subscribe", subscriptions=[{"id": i, "channelId": one} for i, one in enumerate(known.values())])
    def missed():
        for _ in range(500):
            values(quick)
        return max(one["dropped"] for one in server.get("/api/v1/status").json()["clients"]) > 10000
    wait_for(missed, "a client that is behind")
    text = word(slow, "status")["message"]
    assert re.match(r"\d+ messages were left out", text), text


def test_a_node_that_goes_takes_its_channels_along(setting):
    node = setting.start_node()
    client = connect(setting.start_server())
    before = channels(client)
    client.say(op="subscribe", subscriptions=[{"id": 1, "channelId": before["knu::Robot::tick"]}])
    values(client)
    setting.end(node)
    assert setting.start_node("many", "3")
    assert sorted(word(client, "unadvertise")["channelIds"]) == sorted(before.values())
    after = channels(client)
    assert {"many::v0", "many::v1", "many::v2"} <= set(after) and not set(after.values()) & set(before.values())
    client.say(op="subscribe", subscriptions=[{"id": 1, "channelId": after["many::v1"]}])
    assert values(client)[0] == 1


def test_the_verb_waits_on_its_port(setting):
    setting.start_node()
    child = setting.start(setting.programs / "indurop", "stream", "tick", "gain", "--foxglove", "--port", "0", "--node", setting.node)
    port = int(re.search(r":(\d+)/", child.stdout.readline()).group(1))
    client = WebSocket(port, PROTOCOL, path="/", origin="https://app.foxglove.dev")
    assert sorted(channels(client)) == ["knu::Robot::gain", "knu::Robot::tick"]
    client.close()
    for wrong in (["--remote"], ["--hz", "200"]):
        assert setting.start(setting.programs / "indurop", "stream", "tick", "--foxglove", *wrong).wait(30) == 2


if __name__ == "__main__":
    harness.main(globals())
