#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What bad situations get from indurop-serve: each has its test, listed here, and what chance finds. situations_test.py PROGRAMS
FAKE_NODE [TEST...]"""

import json
import pathlib
import random

import harness
from websocket import BINARY, Closed, TEXT, WebSocket

API = "/api/v1"
HERE = pathlib.Path(__file__).parent

# situation: file, test
SITUATIONS = {
    "50 clients": ("stream_test.py", "test_fifty_clients"),
    "more clients than allowed": ("stream_test.py", "test_no_more_clients_than_allowed"),
    "a client that never reads": ("stream_test.py", "test_a_client_that_never_reads_loses_frames_and_no_other_client_does"),
    "5 000 variables": ("stream_test.py", "test_five_thousand_variables"),
    "node gone and back": ("stream_test.py", "test_a_node_that_comes_back_goes_on"),
    "node gone and back, on the page": ("../web/page.mjs", "The page reports a stopped server and a stopped node, and resumes when they are back"),
    "plant with a dead board": ("plant_test.py", "test_shows_boards_and_reports_those_that_die"),
    "plant with a dead board, on the page": ("../web/plant.mjs", "A killed board is reported, and comes back"),
    "type changed while a client follows": ("stream_test.py", "test_another_layout_ends_subscriptions"),
    "type changed while a page is open": ("../web/plant.mjs", "Other variables of a restarted node are shown"),
    "wrong token": ("http_test.py", "test_refuses_those_who_may_not"),
    "wrong token of a stream": ("stream_test.py", "test_refuses_strangers"),
    "expired certificate of a client": ("http_test.py", "test_tls_and_client_certificates"),
    "expired certificate of the server": ("http_test.py", "test_clients_turn_away_an_expired_certificate"),
    "cross-site request": ("http_test.py", "test_refuses_those_who_may_not"),
    "path traversal": ("http_test.py", "test_stays_in_its_folder"),
    "100 MB body": ("http_test.py", "test_takes_no_large_bodies"),
    "slow-loris": ("http_test.py", "test_ends_requests_that_never_end"),
    "garbage instead of HTTP": ("http_test.py", "test_survives_garbage"),
    "garbage in a WebSocket": ("stream_test.py", "test_garbage_is_closed_with_the_right_code"),
    "a fuzzed WebSocket": ("situations_test.py", "test_a_fuzzed_stream_writes_nothing_and_disturbs_no_client"),
    "fuzzed orders": ("situations_test.py", "test_fuzzed_orders_write_nothing_out_of_range"),
    "memory of a node taken away": ("stream_test.py", "test_a_node_whose_memory_is_taken_away"),
    "a full disk, so that nothing can be logged": ("http_test.py", "test_does_nothing_that_it_cannot_log"),
    "a client that holds a force is lost": ("http_test.py", "test_a_lease_ends_with_its_client"),
    "pointer, page or server lost while a robot moves": (
        "../web/page.mjs", "The robot is jogged while a button is held down, and stops when the pointer, the page or the server is lost"),
    "a jog that is not renewed": ("jog_test.py", "test_a_jog_that_is_not_renewed_is_released"),
    "a locked board": ("http_test.py", "test_a_locked_board_is_not_written"),
}


def test_every_situation_has_its_test(_setting):
    for situation, (file, name) in SITUATIONS.items():
        text = (HERE / file).read_text()
        assert f"def {name}(" in text or f'"{name}"' in text, f"{situation}: no test {name} in {file}"


def damaged(data, rng):
    """Bytes with some of them changed, taken out, doubled, or moved."""
    data = bytearray(data)
    for _ in range(rng.randrange(1, 6)):
        at = rng.randrange(len(data) + 1)
        what = rng.randrange(4)
        if what == 0 and at < len(data):
            data[at] = rng.randrange(256)
        elif what == 1:
            del data[at:at + rng.randrange(1, 8)]
        elif what == 2:
            data[at:at] = data[at:at + rng.randrange(1, 16)]
        else:
            data[at:at] = rng.choice([b"{", b"[", b'"', b"\\u0000", b"1e999", b"-0", b"\xff", b"null", b"A" * 300])
    return bytes(data)


WORDS = [
    {"type": "subscribe", "id": 1, "names": ["tick", "joints[1].y", "knu::*"], "rate_hz": 25, "binary": True},
    {"type": "subscribe", "id": 4294967295, "names": ["station::name"], "rate_hz": 0.1},
    {"type": "unsubscribe", "id": 1},
    {"type": "set", "id": 1, "values": {"gain": 5}},
]


def test_a_fuzzed_stream_writes_nothing_and_disturbs_no_client(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    gain = lambda: server.get(f"{API}/boards/{setting.node}/variables/gain").json()["value"]
    before = gain()
    calm = WebSocket(server.port)
    calm.say(type="subscribe", id=1, names=["tick"], rate_hz=50)
    calm.heard("subscribed")
    last = calm.heard("values")["seq"]
    rng = random.Random(16)
    for round_number in range(300):
        wild = WebSocket(server.port)
        try:
            for _ in range(rng.randrange(1, 5)):
                word = json.dumps(rng.choice(WORDS)).encode()
                if rng.random() < 0.6:
                    wild.send_frame(rng.choice([TEXT, TEXT, TEXT, BINARY, 0, 9, 10]), damaged(word, rng), mask=rng.random() < 0.9,
                                    final=rng.random() < 0.8, reserved=rng.choice([0, 0, 0, rng.randrange(8)]))
                else:  # the frame itself is damaged
                    wild.socket.sendall(damaged(b"\x81\xfe" + len(word).to_bytes(2, "big") + b"\0\0\0\0" + word, rng))
        except OSError:
            pass  # it was closed meanwhile
        wild.close()
        if round_number % 10 == 0:
            values = calm.heard("values")
            assert values["seq"] > last and values["alive"], values
            last = values["seq"]
    assert gain() == before and server.get(API + "/audit").json()["audit"] == []
    assert server.child.poll() is None and server.get(API + "/status").status == 200
    calm.close()


def test_fuzzed_orders_write_nothing_out_of_range(setting):
    setting.start_node("robot")
    server = setting.start_server("--write", "--token-file", setting.tokens)
    base = f"{API}/boards/{setting.node}"
    rng = random.Random(17)
    orders = [("/set", {"values": {"gain": 5, "joints[1]": {"y": 170}}, "reason": "x"}),
              ("/force", {"values": {"joints[2].y": -180, "gain": 10}, "for_ns": 1000000}), ("/force", {"values": {"gain": 1}, "lease": True}),
              ("/release", {"names": ["gain"]}), ("/lock", {"lock": "none"}),
              ("/jog", {"robot": "arm", "frame": "axes", "speed": [0, 50, 0, 0, 0, 0]})]
    codes = {}
    for _ in range(600):
        path, body = rng.choice(orders)
        status = server.post(base + path, damaged(json.dumps(body).encode(), rng)).status
        codes[status] = codes.get(status, 0) + 1
        assert status in (200, 400, 404, 409, 413, 422, 423), status
    assert codes.get(400, 0) > 100, codes
    values = {one["name"]: one["value"] for one in server.get(base + "/variables").json()["variables"]}
    assert 0 <= values["knu::Robot::gain"] <= 10 and all(abs(one["y"]) <= 180 for one in values["knu::Robot::joints"]), values
    switch = values["arm::ROBOT_JOG"]
    assert all(abs(one) <= 100 for one in switch["dSpeed"]) and sum(one != 0 for one in switch["dSpeed"]) <= 1, switch
    assert server.child.poll() is None


if __name__ == "__main__":
    harness.main(globals())
