#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop-serve under attack: raw sockets, real certificates of a plant. What may be asked is taken
from tools/serve/openapi.json, so a path that is added is tried by everybody, too. attack_test.py PROGRAMS FAKE_NODE [TEST...]"""

import base64
import contextlib
import json
import pathlib
import re
import select
import socket
import ssl
import subprocess
import time

import harness
from harness import TOKEN, wait_for
from websocket import CLOSE, PING, TEXT, Closed, WebSocket

API = "/api/v1"
READ_TOKEN = "a-token-that-only-reads-0123456789"
DESCRIPTION = pathlib.Path(__file__).resolve().parents[3] / "tools" / "serve" / "openapi.json"
PROTOCOLS = ("indurop.v1", "foxglove.websocket.v1", "foxglove.sdk.v1")


def connect(port, certificate=None, tls=False):
    connection = socket.create_connection(("127.0.0.1", port), timeout=harness.DEADLINE_S)
    if not tls:
        return connection
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    if certificate:
        context.load_cert_chain(certificate / "identity.pem", certificate / "identity.key")
    return context.wrap_socket(connection)


def status_of(connection, text):
    """The status that these bytes are answered with; 0: the connection was ended without an answer."""
    connection.sendall(text.encode() if isinstance(text, str) else text)
    received = b""
    with contextlib.suppress(OSError):
        while b"\r\n" not in received and (part := connection.recv(4096)):
            received += part
    return int(received.split()[1]) if received.startswith(b"HTTP/1.1 ") else 0


def ask(port, text, **how):
    with contextlib.closing(connect(port, **how)) as connection:
        return status_of(connection, text)


def get(path="/api/v1/status", *headers, host="Host: localhost"):
    lines = [f"GET {path} HTTP/1.1"] + ([host] if host else []) + list(headers)
    return "\r\n".join(lines) + "\r\n\r\n"


def upgrade(protocols="indurop.v1", *headers, path="/api/v1/stream", host="Host: localhost", to="websocket"):
    return get(path, f"Upgrade: {to}", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
               "Sec-WebSocket-Key: " + base64.b64encode(bytes(16)).decode(),
               *([f"Sec-WebSocket-Protocol: {protocols}"] if protocols else []), *headers, host=host)


def everything():
    """(kind, request) of all that can be asked; a request takes headers."""
    paths = json.loads(DESCRIPTION.read_text())["paths"]
    for path, methods in paths.items():
        for method in methods:
            if method in ("get", "post"):
                where = path.replace("{", "").replace("}", "")  # of a board that is not there: nothing is done
                kind = ("page" if (method, path) == ("post", "/api/v1/session") else
                        "administer" if path.startswith("/api/v1/users") else
                        "write" if method == "post" and not path.startswith("/api/v1/session/") else "read")
                yield kind, f"{method} {where}", lambda *headers, m=method.upper(), w=where, **k: get(w, *headers, **k).replace(
                    "GET", m, 1)
    for protocol in PROTOCOLS:
        yield "stream", protocol, lambda *headers, p=protocol, **k: upgrade(p, *headers, **k)
    yield "page", "page", lambda *headers, **k: get("/", *headers, **k)


def plant_keys(setting):
    folder = setting.folder / "keys"
    (setting.folder / "plant.xml").write_text(
        "<plant name='cell'><board name='drive'></board></plant>")
    indurop = lambda *words: subprocess.run([setting.programs / "indurop", "keys", *words, "--dir", folder],
                                            env=setting.environment, check=True, capture_output=True, text=True)
    indurop("init", setting.folder / "plant.xml")
    indurop("add", "--tool", "panel", "--read", "cell::*")
    indurop("add", "--tool", "hand", "--write", "cell::target")
    indurop("add", "--deployer", "bob")
    indurop("add", "--viewer", "eve")
    return folder, indurop


def server_for(setting, loopback, write):
    setting.tokens.write_text(f"ana {TOKEN}\ndesk {READ_TOKEN} read\n")
    options = ["--token-file", setting.tokens] + (["--write"] if write else [])
    if not loopback:
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout",
                        "server.key", "-out", "server.pem", "-subj", "/CN=server", "-days", "10"], cwd=setting.folder,
                       check=True, capture_output=True)
        options += ["--bind", "0.0.0.0", "--cert", setting.folder / "server.pem", "--key", setting.folder / "server.key",
                    "--client-ca", setting.folder / "keys" / "ca.pem"]
    return setting.start_server(*options)


def allowed(kind, loopback, write, reads, writes, wrong):
    """What is expected, from nothing but who asks: True, or the statuses of a refusal."""
    if kind == "page":
        return True
    if wrong or not (reads or loopback):
        return (401,)
    if kind in ("read", "stream"):
        return True
    return True if kind == "write" and write and writes else (401, 403)


def test_who_may_what(setting):
    folder, keys = plant_keys(setting)
    revoked = setting.folder / "revoked"
    keys("add", "--deployer", "gone")
    (folder / "deployers" / "gone").rename(revoked)
    revoked_copy = folder / "deployers" / "gone"
    subprocess.run(["cp", "-a", revoked, revoked_copy], check=True)
    keys("revoke", "gone")
    bearer = lambda token: f"Authorization: Bearer {token}"
    askers = [("no token", [], None, False, False, False), ("wrong token", [bearer(TOKEN[:-1] + "x")], None, False, False, True),
              ("half a token", [bearer(TOKEN[:25])], None, False, False, True),
              ("read token", [bearer(READ_TOKEN)], None, True, False, False),
              ("write token", [bearer(TOKEN)], None, True, True, False)]
    certificates = [("tool that reads", folder / "tools/panel", False), ("tool that sets", folder / "tools/hand", False),
                    ("viewer", folder / "viewer", False), ("further viewer", folder / "viewers/eve", False),
                    ("board", folder / "boards/drive", False), ("deployer", folder / "deployer", True),
                    ("further deployer", folder / "deployers/bob", True)]
    tried = 0
    for loopback in (True, False):
        for write in (True, False):
            server = None
            here = list(askers)
            if not loopback:
                here += [(name, [], where, True, writes, False) for name, where, writes in certificates]
                here += [("revoked deployer", [], revoked, False, False, True),
                         ("wrong token of a deployer", [bearer("x" * 30)], folder / "deployer", False, False, True)]
            for who, headers, certificate, reads, writes, wrong in here:
                if server is None or wrong:  # a new server has heard no wrong token yet, and holds the first ones not back
                    if server:
                        setting.end(server.child)
                    server = server_for(setting, loopback, write)
                for kind, what, request in everything():
                    if wrong and what not in ("page", "indurop.v1", "get /api/v1/status", "post /api/v1/boards/board/set"):
                        continue  # tests/unit/tools/serve asks for all of them
                    status = ask(server.port, request(*headers), certificate=certificate, tls=not loopback)
                    expected = allowed(kind, loopback, write, reads, writes, wrong)
                    right = status in expected if expected is not True else status not in (0, 401, 403, 421)
                    assert right, (who, what, "loopback" if loopback else "elsewhere", write, status, expected)
                    tried += 1
            setting.end(server.child)
    print(f"        {tried} combinations", flush=True)


def test_a_name_that_is_not_ours_gets_nothing(setting):
    server = setting.start_server("--write", "--token-file", setting.tokens)
    variants = {"Host: evil.com": 421, "Host: localhost:evil.com": 421, "Host: localhost.evil.com": 421,
                "Host: evil.com:8080": 421, "Host: [::1]evil": 421, "Host: localhost:": 421, "Host: localhost:123456": 421,
                "Host: localhost\r\nHost: evil.com": 400, "Host: evil.com\r\nHost: localhost": 400,
                "Host: localhost\r\nHost: localhost": 400, "Host:": 400, "": 400, " Host: localhost": 400,
                "Host : localhost": 400, "Host: localhost\r\n evil.com": 400, "X: y\nHost: localhost": 400}
    for host, expected in variants.items():
        for kind, what, request in everything():
            if kind in ("stream", "page") or "status" in what or "/set" in what:
                assert ask(server.port, request(f"Authorization: Bearer {TOKEN}", host=host)) == expected, (host, what)
    for origin in ("http://evil.com", "null", "http://localhost:1", "https://localhost", "http://localhost.evil.com"):
        for kind, what, request in everything():
            if kind == "stream" or "/set" in what:
                assert ask(server.port, request(f"Origin: {origin}", f"Authorization: Bearer {TOKEN}")) == 403, (origin, what)
    with contextlib.closing(connect(server.port)) as connection:
        connection.sendall(get("/").replace("GET", "HEAD", 1).encode())
        received = b"".join(iter(lambda: connection.recv(4096), b""))
        assert received.startswith(b"HTTP/1.1 405 ") and received.endswith(b"\r\n\r\n"), received
    for target in ("http://localhost/api/v1/status", "//evil.com/", "*", "status", "/api/v1/status HTTP/1.1\r\nX: y\r\n"):
        assert ask(server.port, get(target)) in (400, 404), target


def test_no_other_protocol_is_spoken(setting):
    server = setting.start_server("--clients", "4")
    for protocols in ("listener", "http", "raw", "", "listener, http", "indurop.v2"):
        for host in ("Host: localhost", "Host: evil.com"):
            assert ask(server.port, upgrade(protocols, "Origin: http://evil.com", host=host)) in (400, 403, 421), protocols
            assert ask(server.port, upgrade(protocols)) == 400, protocols
    for to in ("h2c", "H2C", "websocket, h2c", "raw", "TLS/1.0"):
        assert ask(server.port, upgrade(to=to).replace("Sec-", "HTTP2-Settings: AAMAAABkAAQAAP__\r\nSec-", 1)) == 400, to
    for text in ("CONNECT localhost:80 HTTP/1.1\r\nHost: localhost\r\n\r\n", "GET / HTTP/2.0\r\nHost: localhost\r\n\r\n"):
        assert ask(server.port, text) == 400, text
    assert ask(server.port, b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + bytes(50)) in (0, 400)
    wrong = [upgrade().replace("Version: 13", "Version: 8"), upgrade().replace("Version: 13\r\n", "Version: 13\r\nX-"),
             upgrade().replace("AAAA", "", 1), upgrade().replace("Connection: Upgrade", "Connection: close"),
             upgrade().replace("GET", "POST"), upgrade("indurop.v1", "Content-Length: 5")]
    for text in wrong:
        assert ask(server.port, text) in (400, 403), text
    for number in range(4):  # a list may be long, and ours may be its last
        assert ask(server.port, upgrade("x" * 300 + ", listener, indurop.v1")) == 101, number


def code_after(port, data):
    client = WebSocket(port)
    client.socket.sendall(data)
    try:
        while True:
            client.frame()
    except Closed as closed:
        return closed.code
    finally:
        client.close()


def test_frames_without_a_mask_are_a_fault_of_the_protocol(setting):
    setting.start_node()
    server = setting.start_server()
    for opcode, data in ((TEXT, b'{"type":"subscribe"}'), (TEXT, b""), (PING, b"x"), (CLOSE, b"\x03\xe8"), (TEXT, b" " * 300)):
        size = bytes([len(data)]) if len(data) < 126 else b"\x7e" + len(data).to_bytes(2, "big")
        assert code_after(server.port, bytes([0x80 | opcode]) + size + data) == 1002, (opcode, data)
    masked = bytes([0x81, 0x80 | 2]) + bytes(4) + b"{}"
    assert code_after(server.port, masked + b"\x81\x02{}") in (1002, 1007), "after one with a mask, too"
    assert ask(server.port, get()) == 200


def opened(port, count, data=b""):
    connections = []
    for _ in range(count):
        connection = socket.create_connection(("127.0.0.1", port), timeout=harness.DEADLINE_S)
        with contextlib.suppress(OSError):  # ended already for others that came
            connection.sendall(data)
        connections.append(connection)
    return connections


def test_idle_and_dripping_connections_lock_no_client_out(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    client = WebSocket(server.port)
    client.say(type="subscribe", id=1, names=["tick"], rate_hz=20)
    client.heard("subscribed")
    held = []
    for data in (b"", b"GET / HTTP/1.1\r\nHost: localhost\r\nX: ", get().encode(), b"\x16\x03\x01",
                 f"POST {API}/boards/{setting.node}/set HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n".encode()):
        held += opened(server.port, 320, data)
        for connection in held[-320:]:
            with contextlib.suppress(OSError):
                connection.sendall(b"x")
        for _ in range(5):
            assert ask(server.port, get()) == 200, data
            assert server.post(f"{API}/boards/{setting.node}/set", {"values": {"gain": 2}}).status == 200
        assert client.heard("values")["alive"], "who is served goes on"
    for connection in held:
        connection.close()
    client.close()
    assert ask(server.port, get()) == 200


def test_files_of_others_cost_their_number_and_not_its_square(setting):
    child = setting.start(setting.programs / "indurop-serve", "--port", 0)
    server = harness.Server(int(re.search(r":(\d+)/", child.stdout.readline()).group(1)), child)
    costs = []
    for many in (150, 600):
        for number in range(many):
            pathlib.Path(f"/dev/shm/indurop.{setting.node}-{number}").write_bytes(bytes(4096))
        begin, asked = server.cpu_seconds(), 0
        while server.cpu_seconds() - begin < 0.5:
            assert server.get(API + "/boards").status == 200
            asked += 1
        costs.append((server.cpu_seconds() - begin) / asked)
    assert costs[1] < 9 * costs[0], costs  # four times as many: 4 times as much, or 16 times


def test_who_only_looks_cannot_take_all_streams(setting):
    server = setting.start_server("--write", "--token-file", setting.tokens, "--clients", "16")
    held, refused = [], 0
    for _ in range(320):
        connection = connect(server.port)
        if status_of(connection, upgrade()) == 101:
            held.append(connection)
        else:
            connection.close()
            refused += 1
    assert len(held) == 14 and refused == 306, (len(held), refused)
    connection = connect(server.port)
    assert status_of(connection, upgrade(f"indurop.v1, indurop.token.{TOKEN}")) == 101, "two are kept for those with a token"
    for one in [*held, connection]:
        one.close()


def test_wrong_tokens_are_held_back_and_noted_down(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    wrong = get("/api/v1/status", "Authorization: Bearer " + "x" * 32)
    at_once = [ask(server.port, wrong) for _ in range(3)]
    assert at_once == [401] * 3
    held = opened(server.port, 100, wrong.encode())
    ready, _, _ = select.select(held, [], [], 0)
    assert len(ready) < len(held), "they wait"
    assert ask(server.port, get("/api/v1/status", f"Authorization: Bearer {TOKEN}")) == 200, "who has the right one does not"
    for connection in held:
        with contextlib.suppress(OSError):
            received = connection.recv(4096)
            assert received == b"" or received.startswith(b"HTTP/1.1 401"), received[:50]
        connection.close()
    noted = wait_for(lambda: [one for one in server.get(API + "/audit").json()["audit"] if one["action"] == "refused"],
                     "a note")
    assert len(noted) == 1 and noted[0]["from"] == "127.0.0.1" and "token is wrong" in noted[0]["outcome"], noted


def test_a_certificate_that_is_revoked_counts_no_more(setting):
    folder, keys = plant_keys(setting)
    server = server_for(setting, False, True)
    deployer = folder / "deployers" / "bob"
    order = get(f"{API}/boards/none/set").replace("GET", "POST", 1)
    assert ask(server.port, order, certificate=deployer, tls=True) == 404, "it may, there is only no such board"
    stays = connect(server.port, certificate=deployer, tls=True)
    assert status_of(stays, get()) == 200
    follows = connect(server.port, certificate=deployer, tls=True)
    assert status_of(follows, upgrade()) == 101
    keys("revoke", "bob")
    assert ask(server.port, order, certificate=deployer, tls=True) == 401
    assert ask(server.port, upgrade(), certificate=deployer, tls=True) == 401
    with contextlib.suppress(OSError):
        while select.select([stays], [], [], 0.2)[0] and stays.recv(65536):
            pass
    assert status_of(stays, order) == 401, "nor on a connection from before"
    stays.close()
    received = b""
    while (part := follows.recv(65536)):
        received += part
    assert received.endswith(b"\x88\x02\x03\xf0"), received[-20:]  # its stream ends with 1008
    follows.close()
    noted = wait_for(lambda: json.loads(subprocess.run(
        [setting.programs / "indurop", "audit", "-o", "json"], env=setting.environment, capture_output=True,
        text=True, check=True).stdout)["audit"], "a note")
    assert noted[0]["who"] == "bob" and "revoked" in noted[0]["outcome"], noted


def test_a_list_that_cannot_be_read_is_a_refusal_and_no_broken_connection(setting):
    """OpenSSL: the error queue of the thread has to be empty before each SSL_read() (SSL_get_error(3))."""
    folder, _ = plant_keys(setting)
    server = server_for(setting, False, True)
    order = get(f"{API}/boards/none/set").replace("GET", "POST", 1)
    for content in ("", "-----BEGIN X509 CRL-----\nnone\n-----END X509 CRL-----\n"):
        good = (folder / "revoked.pem").read_text()
        with contextlib.closing(connect(server.port, certificate=folder / "deployer", tls=True)) as stays:
            assert status_of(stays, get()) == 200
            (folder / "revoked.pem").write_text(content)
            assert status_of(stays, order) == 401, content
        (folder / "revoked.pem").write_text(good)
        assert ask(server.port, order, certificate=folder / "deployer", tls=True) == 404, "it counts again"


def test_a_slow_tls_handshake_locks_no_client_out(setting):
    plant_keys(setting)
    server = server_for(setting, False, True)
    held = opened(server.port, 320, b"\x16\x03\x01\x02\x00\x01\x00")
    begin = time.monotonic()
    assert ask(server.port, get("/api/v1/status", f"Authorization: Bearer {TOKEN}"), tls=True) == 200
    for connection in held:  # all are ended, although no client sends anything
        connection.settimeout(harness.DEADLINE_S)
        with contextlib.suppress(OSError):
            assert connection.recv(10) in (b"", b"\x15\x03\x01\x00\x02\x02F"), time.monotonic() - begin
        connection.close()


if __name__ == "__main__":
    harness.main(globals())
