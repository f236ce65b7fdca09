#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What hostile clients do to indurop-opcua: garbage, huge messages, connections that send nothing, more sessions and items than
allowed. A client that behaves is served all the time. attack_test.py PROGRAMS FAKE_NODE [TEST...]"""

import pathlib
import random
import re
import socket
import struct

from opcua_harness import Client, Failed, main, wait_for


def begin(setting, *options):
    setting.start_node("many", "50")
    endpoint = setting.start_opcua(setting.start_server(), "--anonymous", *options)
    client = setting.client(endpoint)
    node = setting.id("knu::Robot::tick")
    client.do("monitor", nodes=[node])
    client.becomes(node, lambda one: one["code"] == "Good", "a value")
    return endpoint, client, int(re.search(r":(\d+)$", endpoint).group(1))


def goes_on(setting, client):
    node = setting.id("knu::Robot::tick")
    count = client.do("changes")[node]["count"]
    client.becomes(node, lambda one: one["count"] > count + 1, "values to go on")
    assert setting.opcua.poll() is None


def send(port, data, wait=True):
    with socket.create_connection(("127.0.0.1", port), timeout=30) as connection:
        try:
            connection.sendall(data)
            if wait:
                connection.settimeout(5)
                return connection.recv(4096)
        except (OSError, TimeoutError):
            pass
    return b""


def hello(receive=65536, message=0, url=b"opc.tcp://localhost:4840"):
    body = struct.pack("<IIIII", 0, receive, 65536, message, 0) + struct.pack("<i", len(url)) + url
    return b"HELF" + struct.pack("<I", 8 + len(body)) + body


def test_garbage(setting):
    _, client, port = begin(setting)
    chance = random.Random(1)
    assert send(port, hello())[:4] == b"ACKF"
    for data in (b"GET / HTTP/1.1\r\n\r\n", b"\0" * 100, b"HELF\xff\xff\xff\xff" + b"x" * 5000, hello()[:20],
                 hello(url=b"x" * 5000), hello(receive=1), hello() + b"OPNF\xff\xff\xff\x7f" + b"y" * 70_000,
                 hello() + b"MSGF" + struct.pack("<I", 64) + bytes(56), hello() + b"OPNF" + struct.pack("<I", 132) + bytes(124)):
        send(port, data, wait=False)
    for _ in range(60):
        data = bytearray(hello() + b"OPNF" + struct.pack("<I", 132) + b"\0\0\0\0\x2f\0\0\0http://opcfoundation.org/UA/SecurityPolicy#None" + bytes(64))
        for _ in range(chance.randrange(1, 8)):
            data[chance.randrange(len(data))] = chance.randrange(256)
        send(port, bytes(data), wait=False)
    goes_on(setting, client)


def test_connections_that_send_nothing(setting):
    endpoint, client, port = begin(setting, "--sessions", "4")
    idle = []
    for _ in range(60):
        try:
            idle.append(socket.create_connection(("127.0.0.1", port), timeout=5))
        except OSError:
            break
    goes_on(setting, client)
    for connection in idle:
        connection.close()
    wait_for(lambda: connects(setting, endpoint), "room for another client")


def connects(setting, endpoint):
    client = Client(setting, endpoint)
    try:
        client.connect()
        return True
    except Failed:
        return False
    finally:
        setting.end(client.child)


def test_no_more_sessions_and_items_than_allowed(setting):
    endpoint, client, _ = begin(setting, "--sessions", "2", "--items", "20")
    second = setting.client(endpoint)
    third = Client(setting, endpoint)
    try:
        third.connect()
        raise AssertionError("there is a session too many")
    except Failed as failure:
        assert "TooMany" in str(failure) or "Bad" in str(failure), failure
    nodes = [setting.id(f"many::v{i}") for i in range(30)]
    refused = ""
    try:
        answers = second.do("monitor", nodes=nodes)
        refused = " ".join(answers)
    except Failed as failure:
        refused = str(failure)
    assert "BadTooManyMonitoredItems" in refused, refused
    goes_on(setting, client)


def test_memory_stays_where_it_is(setting):
    _, client, port = begin(setting)
    resident = lambda: int(re.search(r"VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{setting.opcua.pid}/status").read_text()).group(1))
    before = resident()
    # Connections, each with the first chunks of a message that never ends
    connections = [socket.create_connection(("127.0.0.1", port), timeout=10) for _ in range(50)]
    for connection in connections:
        try:
            connection.sendall(hello() + b"OPNC" + struct.pack("<I", 8192) + bytes(8184) + b"MSGC" + struct.pack("<I", 8192) + bytes(8184))
        except OSError:
            pass
    goes_on(setting, client)
    for connection in connections:
        connection.close()
    assert resident() < before + 200_000, (before, resident())


if __name__ == "__main__":
    main(globals())
