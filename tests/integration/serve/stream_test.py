#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The stream of indurop-serve: values, slow clients, boards that go and come, garbage. stream_test.py PROGRAMS FAKE_NODE [TEST...]"""

import struct
import subprocess
import time

import harness
from harness import TOKEN, wait_for
from websocket import BINARY, CLOSE, TEXT, Closed, Refused, WebSocket

API = "/api/v1"


def begin(setting, *options, node=(), **more):
    setting.start_node(*node)
    server = setting.start_server(*options, **more)
    return server, WebSocket(server.port)


def test_greets_and_names_the_boards(setting):
    _, client = begin(setting)
    assert client.heard("hello")["api"].startswith("1.")
    board = client.heard("boards")["boards"][0]
    assert board["board"] == setting.node and board["alive"] and len(board["layout"]) == 16
    client.close()


def test_streams_json(setting):
    server, client = begin(setting, "--write", "--token-file", setting.tokens)
    client.say(type="subscribe", id=1, names=["tick", "joints[0].x", "station::*", "gian"], rate_hz=50)
    answer = client.heard("subscribed")
    assert [one["name"] for one in answer["variables"]] == [
        "knu::Robot::tick", "knu::Robot::joints[0].x", "station::name", "station::starts"]
    assert answer["missing"][0]["name"] == "gian" and "gain" in answer["missing"][0]["message"]
    first = client.heard("values")
    assert first["full"] and first["alive"] and len(first["values"]) == 4 and first["stream"] == answer["stream"]
    last = first
    for _ in range(5):
        next_one = client.heard("values")
        assert not next_one["full"] and next_one["seq"] == last["seq"] + 1
        assert next_one["time_ns"] > last["time_ns"] and "station::name" not in next_one["values"]
        last = next_one
    server.post(f"{API}/boards/{setting.node}/force", {"values": {"tick": 5}})
    wait_for(lambda: client.heard("values")["forced"] == ["knu::Robot::tick"], "the force")
    client.say(type="unsubscribe", id=1)
    assert client.heard("unsubscribed")["id"] == 1
    client.close()


def test_streams_binary(setting):
    server, client = begin(setting)
    client.say(type="subscribe", id=9, board=setting.node, names=["mode", "tick", "joints", "name"], rate_hz=100, binary=True)
    answer = client.heard("subscribed")
    at = {one["name"]: one["offset"] for one in answer["variables"]}
    seen = []
    for _ in range(10):
        data = client.heard("binary")
        version, kind, flags, stream, seq, time_ns, wall_ns, reserved = struct.unpack_from("<BBHIQqqq", data)
        assert (version, kind, flags, stream, reserved) == (1, 1, 1, answer["stream"], 0)
        assert len(data) == answer["record_size"] and abs(wall_ns - time.time_ns()) < 60 * 10**9
        assert data[answer["quality_offset"]:] == bytes(4)
        tick = struct.unpack_from("<I", data, at["knu::Robot::tick"])[0]
        x = struct.unpack_from("<d", data, at["knu::Robot::joints"])[0]
        assert abs(x - tick * 0.5) < 50
        seen.append((seq, tick, time_ns))
    assert seen == sorted(seen) and seen[-1][1] > seen[0][1]
    client.close()


def test_shares_what_is_the_same(setting):
    server, first = begin(setting)
    second = WebSocket(server.port)
    streams = set()
    for client in (first, second):
        client.say(type="subscribe", id=1, names=["tick"], rate_hz=20)
        streams.add(client.heard("subscribed")["stream"])
    assert len(streams) == 1
    second.say(type="subscribe", id=2, names=["tick"], rate_hz=10)
    assert second.heard("subscribed")["stream"] not in streams
    first.close()
    second.close()


def test_a_client_that_never_reads_loses_frames_and_no_other_client_does(setting):
    server, lazy = begin(setting, node=("many", "5000"))
    names = ["many::*"]
    lazy.say(type="subscribe", id=1, names=names, rate_hz=100, binary=True)
    lazy.heard("binary")  # and nothing after that
    eager = WebSocket(server.port)
    eager.say(type="subscribe", id=1, names=["tick"], rate_hz=50, binary=True)
    eager.heard("subscribed")
    figures = lambda: server.get(API + "/status").json()["clients"]
    wait_for(lambda: any(one["dropped"] > 50 for one in figures()), "dropped frames")
    last = None
    for _ in range(50):
        seq = struct.unpack_from("<Q", eager.heard("binary"), 8)[0]
        last = seq
    assert last
    dropped = lazy.heard("dropped")  # it reads after all
    assert dropped["frames"] >= 1 and dropped["total"] >= dropped["frames"]
    newest = 0
    for _ in range(3):
        newest = struct.unpack_from("<Q", lazy.heard("binary"), 8)[0]
    assert newest > dropped["total"]
    assert next(one for one in figures() if one["dropped"] == 0)["sent"] >= 50
    lazy.close()
    eager.close()


def test_fifty_clients(setting):
    server, first = begin(setting)
    clients = [first] + [WebSocket(server.port) for _ in range(49)]
    for client in clients:
        client.say(type="subscribe", id=1, names=["knu::*"], rate_hz=20)
    for client in clients:
        for _ in range(3):
            assert client.heard("values")["alive"]
    assert len(server.get(API + "/status").json()["clients"]) == 50
    for client in clients:
        client.close()
    wait_for(lambda: server.get(API + "/status").json()["clients"] == [], "all to be gone")


def test_five_thousand_variables(setting):
    server, client = begin(setting, node=("many", "5000"))
    assert len(server.get(f"{API}/boards/{setting.node}/variables?match=many::*").json()["variables"]) == 5000
    client.say(type="subscribe", id=1, names=["many::*"], rate_hz=25, binary=True)
    answer = client.heard("subscribed")
    assert len(answer["variables"]) == 5000 and not answer["missing"]
    first = client.heard("binary")
    assert len(first) == answer["record_size"] > 5000 * 9
    wait_for(lambda: client.heard("binary")[40:48] != first[40:48], "other values")
    client.say(type="subscribe", id=2, names=["many::*"], rate_hz=5)
    assert len(client.heard("values")["values"]) == 5000
    client.close()


def test_no_more_clients_than_allowed(setting):
    server, first = begin(setting, "--clients", "2")
    second = WebSocket(server.port)
    try:
        WebSocket(server.port)
        raise AssertionError("a third one was let in")
    except Refused as refused:
        assert refused.status == 503
    second.close()
    wait_for(lambda: len(server.get(API + "/status").json()["clients"]) == 1, "the second to be gone")
    WebSocket(server.port).close()
    first.close()


def test_a_node_that_comes_back_goes_on(setting):
    node = setting.start_node()
    server = setting.start_server()
    client = WebSocket(server.port)
    client.say(type="subscribe", id=1, names=["tick"], rate_hz=50)
    client.heard("subscribed")
    assert client.heard("values")["alive"]
    setting.end(node)
    wait_for(lambda: not client.heard("values")["alive"], "the node to be gone")
    setting.start_node()
    wait_for(lambda: client.heard("values")["alive"], "the node to be back")
    client.close()


def test_another_layout_ends_subscriptions(setting):
    node = setting.start_node()
    server = setting.start_server()
    client = WebSocket(server.port)
    before = client.heard("boards")["boards"][0]["layout"]
    for number in (1, 2):
        client.say(type="subscribe", id=number, names=["tick"], rate_hz=10 * number, binary=number == 2)
        client.heard("subscribed")
    setting.end(node)
    setting.start_node("many", "3")
    ended = []
    while len(ended) < 2:
        word = client.heard("layout_changed")
        assert word["board"] == setting.node and word["layout"] != before
        ended += word["ids"]
    assert sorted(ended) == [1, 2]
    client.say(type="subscribe", id=1, names=["tick", "many::v2"], rate_hz=20)
    assert client.heard("subscribed")["layout"] != before
    assert client.heard("values")["full"]
    client.close()


def test_a_node_whose_memory_is_taken_away(setting):
    node = setting.start_node()
    server = setting.start_server()
    client = WebSocket(server.port)
    client.say(type="subscribe", id=1, names=["tick", "joints"], rate_hz=50)
    client.heard("subscribed")
    setting.end(node)
    subprocess.run([setting.programs / "indurop", "clean", setting.node], env=setting.environment, check=False,
                   capture_output=True)
    word = wait_for(lambda: (word := client.heard("values")) and not word["alive"] and word, "the node to be gone")
    setting.start_node("many", "2")
    client.heard("layout_changed")
    client.close()


def test_what_makes_no_sense_is_answered(setting):
    _, client = begin(setting)
    for word in ({"type": "subscribe", "id": 1}, {"type": "subscribe", "id": 1, "names": ["tick"], "rate_hz": 1000},
                 {"type": "subscribe", "id": 1, "names": ["tick"], "board": "missing"}, {"type": "set", "id": 1}, {}):
        client.say(**word)
        answer = client.heard("error")
        assert answer["id"] == word.get("id") and answer["message"], answer
    client.say(type="subscribe", id=1, names=["nothing"])
    assert client.heard("subscribed")["variables"] == []
    assert client.heard("values")["values"] == {}
    for number in range(40):
        client.say(type="subscribe", id=number, names=["tick"], rate_hz=1)
    assert "at most" in client.heard("error")["message"]
    client.close()


def code_after(server, act):
    client = WebSocket(server.port)
    act(client)
    try:
        while True:
            client.frame()
    except Closed as closed:
        return closed.code
    except ConnectionResetError:
        return None
    finally:
        client.close()


def test_garbage_is_closed_with_the_right_code(setting):
    setting.start_node()
    server = setting.start_server()
    deep = b'{"type":' + b"[" * 1000 + b"]" * 1000 + b"}"
    for act, codes in ((lambda c: c.send_frame(TEXT, b"no json"), (1007,)), (lambda c: c.send_frame(TEXT, b"[1]"), (1007,)),
                       (lambda c: c.send_frame(TEXT, b"\xff\xfe{}"), (1007,)), (lambda c: c.send_frame(TEXT, deep), (1007,)),
                       (lambda c: c.send_frame(BINARY, b"{}"), (1003,)),
                       (lambda c: c.send_frame(TEXT, b" " * 70000), (1009,)),
                       (lambda c: c.send_frame(5, b"x"), (1002, None)),
                       (lambda c: c.send_frame(TEXT, b"x", reserved=4), (1002, None)),
                       (lambda c: c.send_frame(CLOSE, b"\x03\xe8"), (1000,)),
                       (lambda c: c.socket.sendall(bytes(range(256)) * 20), (1002, 1003, 1007, None))):
        code = code_after(server, act)
        assert code in codes, (code, codes)
        assert server.get(API + "/status").status == 200


def test_refuses_strangers(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    for more, status in (({"origin": "http://evil.example"}, 403), ({"host": "evil.example"}, 421),
                         ({"protocols": ("indurop.v1", "indurop.token.wrong")}, 401), ({"path": "/api/v1/status"}, 404),
                         ({"protocols": ()}, 400)):
        try:
            WebSocket(server.port, **more).close()
            raise AssertionError(f"{more} was let in")
        except Refused as refused:
            assert refused.status == status, (more, refused.status)
    WebSocket(server.port, protocols=("indurop.v1", "indurop.token." + TOKEN)).close()
    WebSocket(server.port, origin=f"http://127.0.0.1:{server.port}").close()


if __name__ == "__main__":
    harness.main(globals())
