#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What indurop-serve answers over HTTP, and what it refuses. http_test.py PROGRAMS FAKE_NODE [TEST...]"""

import http.client
import json
import pathlib
import shutil
import signal
import socket
import ssl
import subprocess
import time

import harness
from harness import TOKEN, wait_for

API = "/api/v1"
SOURCE = pathlib.Path(__file__).resolve().parents[3]


def listens_on(port):
    """Addresses of this process' sockets on a port, as /proc/net/tcp has them."""
    found = []
    for table in ("tcp", "tcp6"):
        for line in pathlib.Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
            words = line.split()
            address, number = words[1].split(":")
            if words[3] == "0A" and int(number, 16) == port:
                found.append(address)
    return found


def test_is_seen_from_this_machine_only(setting):
    server = setting.start_server()
    assert listens_on(server.port) == ["0100007F"], listens_on(server.port)


def test_shows_a_board(setting):
    setting.start_node()
    server = setting.start_server()
    board = server.get(API + "/boards").json()["boards"][0]
    assert board["board"] == setting.node and board["alive"] and board["state"] == "running"
    modules = server.get(f"{API}/boards/{setting.node}/modules").json()["modules"]
    assert [one["name"] for one in modules] == ["modify", "output", "show"]
    faults = server.get(f"{API}/boards/{setting.node}/faults").json()["faults"]
    assert any("SIGSEGV" in fault["text"] and fault["module"] == "output" for fault in faults), faults
    runs = server.get(f"{API}/boards/{setting.node}/runs?count=5").json()["runs"]
    assert len(runs) == 5 and runs == sorted(runs, key=lambda one: one["number"])
    last = runs[-1]["number"]
    later = wait_for(lambda: server.get(f"{API}/boards/{setting.node}/runs?after={last}").json()["runs"], "a run")
    assert all(one["number"] > last for one in later)
    for count in ("0", "x", "-1", "99999"):
        assert server.get(f"{API}/boards/{setting.node}/runs?count={count}").status == 400, count


def test_shows_variables(setting):
    setting.start_node()
    server = setting.start_server()
    base = f"{API}/boards/{setting.node}/variables"
    everything = server.get(base).json()["variables"]
    assert {one["name"] for one in everything} >= {"knu::Robot::tick", "knu::Robot::joints", "station::name"}
    gain = next(one for one in everything if one["name"] == "knu::Robot::gain")
    assert gain["unit"] == "mm" and gain["range"] == {"min": 0, "max": 10} and gain["value"] == 1
    assert gain["quality"] == "good" and gain["forced"] == []
    part = server.get(base + "/joints%5B1%5D.y").json()
    assert part["name"] == "knu::Robot::joints[1].y" and part["range"] == {"min": -180, "max": 180}
    assert [one["name"] for one in server.get(base + "?match=station::*&values=false").json()["variables"]] == [
        "station::name", "station::starts"]
    wrong = server.get(base + "/gian")
    assert wrong.status == 404 and "gain" in wrong.json()["message"], wrong.body


def test_writes_for_those_who_may(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    base = f"{API}/boards/{setting.node}"
    value = lambda name: server.get(f"{base}/variables/{name}").json()
    assert server.post(base + "/set", {"values": {"gain": 2.5, "mode": "AUTO", "station::name": "A 1"},
                                       "reason": "try"}).json()["written"] == [
        "knu::Robot::gain", "knu::Robot::mode", "station::name"]
    assert value("gain")["value"] == 2.5 and value("mode")["value"] == "AUTO" and value("name")["value"] == "A 1"
    refused = server.post(base + "/set", {"values": {"gain": 3, "joints[1].y": 190, "nothing": 1}})
    assert refused.status == 422 and len(refused.json()["details"]) >= 2, refused.body
    assert value("gain")["value"] == 2.5
    assert server.post(base + "/force", {"values": {"gain": 4}, "for_ns": 3600 * 10**9}).status == 200
    assert value("gain")["forced"] == ["knu::Robot::gain"]
    forces = server.get(base + "/forces").json()["forces"]
    assert forces[0]["value"] == 4 and 0 < forces[0]["left_ns"] <= 3600 * 10**9
    assert server.post(base + "/set", {"values": {"gain": 1}}).status == 422
    assert server.post(base + "/release", {"names": ["gain"]}).json()["released"] == ["knu::Robot::gain"]
    assert server.post(base + "/set", {"values": {"gain": 1}}).status == 200
    audit = server.get(API + "/audit").json()["audit"]
    done = [one for one in audit if one["outcome"] == "done"]
    assert [one["action"] for one in done] == ["set", "force", "release", "set"], audit
    assert done[0]["who"] == "ana" and done[0]["from"] == "127.0.0.1" and done[0]["reason"] == "try"
    noted = next(pathlib.Path(setting.environment["INDUROP_STATE_DIR"]).glob("*/orders.jsonl")).read_text()
    orders = [json.loads(line) for line in noted.splitlines()]
    assert [(one["action"], one["what"], one["value"]) for one in orders] == [
        ("set", "knu::Robot::gain", "2.5"), ("set", "knu::Robot::mode", "AUTO"), ("set", "station::name", '"A 1"'),
        ("force", "knu::Robot::gain", "4"), ("unforce", "knu::Robot::gain", ""), ("set", "knu::Robot::gain", "1")], orders
    assert {(one["who"], one["from"]) for one in orders} == {("ana", "127.0.0.1")}, orders
    shown = subprocess.run([setting.programs / "indurop", "audit", "-o", "json"], env=setting.environment,
                           capture_output=True, text=True, check=True).stdout
    assert len(json.loads(shown)["audit"]) == len(audit)


def test_holds_structs_and_tells_who_and_why(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    base = f"{API}/boards/{setting.node}"
    said = server.post(base + "/force", {"values": {"joints[1]": {"x": 1.5, "z": 0}, "station::name": "a longer name"},
                                         "reason": "gauge is broken"})
    assert said.status == 200, said.body
    forces = server.get(base + "/forces").json()["forces"]
    assert [(one["name"], one["value"]) for one in forces] == [
        ("knu::Robot::joints[1].x", 1.5), ("knu::Robot::joints[1].z", 0), ("station::name", "a longer name")], forces
    assert all(one["who"] == "ana" and one["reason"] == "gauge is broken" and one["from"] and one["left_ns"] is None
               for one in forces)
    assert server.post(base + "/set", {"values": {"joints[1].y": 4}}).status == 200, "the rest goes on"
    faults = server.get(base + "/faults").json()["faults"]
    assert any("forced" in one["text"] and "ana" in one["text"] for one in faults), faults
    assert server.post(base + "/force", {"values": {"joints[1]": {"y": 190}}}).status == 422, "its range"
    assert server.post(base + "/release", {"all": True}).status == 200


def test_a_lease_ends_with_its_client(setting):
    setting.start_node()
    setting.tokens.write_text(f"ana {TOKEN}\nbob {TOKEN[::-1]}\n")
    server = setting.start_server("--write", "--token-file", setting.tokens)
    base = f"{API}/boards/{setting.node}"
    forces = lambda: server.get(base + "/forces").json()["forces"]
    take = lambda: server.post(base + "/force", {"values": {"gain": 3}, "lease": True}).json()
    assert server.post(base + "/force", {"values": {"gain": 3}, "lease": True, "for_ns": 1}).status == 400
    lease = take()
    renew = f"{base}/leases/{lease['lease']}/renew"
    assert forces()[0]["lease"]
    end = time.monotonic() + 1.5 * lease["lease_ns"] / 1e9
    while time.monotonic() < end:
        assert server.post(renew).status == 200
        assert forces(), "it is renewed"
    assert server.post(renew, token=TOKEN[::-1]).status == 404, "of another user"
    assert server.ask("POST", renew).status == 401
    assert server.post(base + "/leases/nothing/renew").status == 404
    wait_for(lambda: not forces(), "the end of a lease that is not renewed")
    assert server.post(renew).status == 404
    audit = wait_for(lambda: [one for one in server.get(API + "/audit").json()["audit"]
                              if "did not renew it in time" in one["outcome"]], "a note about it")
    assert audit[0]["who"] == "ana" and audit[0]["what"] == "gain=3", audit
    lease = take()
    assert server.post(f"{base}/leases/{lease['lease']}/end").status == 200
    assert not forces()
    take()
    setting.end(server.child, signal.SIGKILL)
    server = setting.start_server("--write", "--token-file", setting.tokens)
    wait_for(lambda: not forces(), "the end of a lease whose server was killed")


def test_a_locked_board_is_not_written(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    base = f"{API}/boards/{setting.node}"
    assert server.get(base + "/forces").json()["lock"]["lock"] == "none"
    assert server.post(base + "/lock", {"lock": "much"}).status == 400
    assert server.ask("POST", base + "/lock", {"lock": "none"}).status == 401
    assert server.post(base + "/lock", {"lock": "tune", "reason": "production"}).status == 200
    assert server.get(base + "/forces").json()["lock"] == {**server.get(base + "/forces").json()["lock"],
                                                           "lock": "tune", "who": "ana", "reason": "production"}
    assert server.post(base + "/set", {"values": {"gain": 2}}).status == 200, "a parameter"
    for path, body in (("/set", {"values": {"mode": "AUTO"}}), ("/force", {"values": {"gain": 1}}),
                       ("/release", {"all": True}), ("/modules/show/stop", None)):
        refused = server.post(base + path, body)
        assert refused.status == 423 and "'tune' by ana (production)" in refused.json()["message"], refused.body
    assert server.get(base).json()["lock"]["lock"] == "tune"
    assert server.post(base + "/lock", {"lock": "none"}).status == 200
    assert server.post(base + "/set", {"values": {"mode": "AUTO"}}).status == 200


def test_answers_a_request_without_a_body_once(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    answer = server.raw((f"POST {API}/boards/{setting.node}/modules/none/start HTTP/1.1\r\nHost: localhost\r\n"
                         f"Authorization: Bearer {TOKEN}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n").encode())
    assert answer.count(b"HTTP/1.1") == 1 and answer.startswith(b"HTTP/1.1 404"), answer


def test_does_nothing_that_it_cannot_log(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens, "--audit", "/proc/nowhere/audit.jsonl")
    answer = server.post(f"{API}/boards/{setting.node}/set", {"values": {"gain": 5}})
    assert answer.status == 500 and "nothing was written" in answer.json()["message"]
    assert server.get(f"{API}/boards/{setting.node}/variables/gain").json()["value"] == 1


def test_refuses_those_who_may_not(setting):
    setting.start_node()
    path, body = f"{API}/boards/{setting.node}/set", {"values": {"gain": 5}}
    reader = setting.start_server()
    assert reader.post(path, body).status == 401  # a token that is none of its own
    assert reader.post(path, body, token=None).status == 403
    server = setting.start_server("--write", "--token-file", setting.tokens)
    assert server.post(path, body, token=None).status == 401
    assert server.post(path, body, token=TOKEN[:-1] + "x").status == 401
    assert server.post(path, body, Origin="http://evil.example").status == 403
    assert server.post(path, body, Sec_Fetch_Site="cross-site").status == 403
    assert server.post(path, body, Content_Type="text/plain").status == 415
    assert server.post(path, body, Host="evil.example").status == 421
    assert server.get(API + "/boards", Host="evil.example").status == 421
    assert server.ask("DELETE", API + "/boards").status == 405
    assert server.ask("PUT", path, body, TOKEN).status == 405
    assert server.get(path).status == 405
    assert server.get(f"{API}/boards/{setting.node}/variables/gain").json()["value"] == 1
    noted = wait_for(lambda: server.get(API + "/audit").json()["audit"], "a note about the wrong token")
    assert [(one["action"], one["from"]) for one in noted] == [("refused", "127.0.0.1")] * 2, noted  # one of each server
    assert all("token is wrong" in one["outcome"] for one in noted), noted


def test_stays_in_its_folder(setting):
    web = setting.folder / "web"
    web.mkdir()
    (web / "index.html").write_text("page")
    (setting.folder / "secret").write_text("secret")
    server = setting.start_server("--web", web)
    assert server.get("/").body == b"page"
    for path in ("/../secret", "/..%2fsecret", "/%2e%2e/secret", "/%2e%2e%2fsecret", "/x/../../secret", "//../secret",
                 "/..%5csecret", "/..%00/secret", "/index.html%00.png"):
        answer = server.raw(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
        assert b"secret" not in answer.split(b"\r\n\r\n", 1)[-1], path
        assert not answer.startswith(b"HTTP/1.1 200"), (path, answer[:200])


def test_says_what_is_missing_of_the_page(setting):
    server = setting.start_server("--web", setting.folder / "nothing")
    answer = server.get("/")
    assert answer.status == 404 and b"npm" in answer.body


def test_takes_no_large_bodies(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    path = f"{API}/boards/{setting.node}/set"
    head = (f"POST {path} HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {TOKEN}\r\n"
            "Content-Type: application/json\r\n")
    with socket.create_connection(("127.0.0.1", server.port), timeout=harness.DEADLINE_S) as connection:
        connection.sendall((head + "Content-Length: 100000000\r\n\r\n").encode())
        answer = connection.recv(65536)  # before any of it has come
        assert answer.startswith(b"HTTP/1.1 413"), answer[:100]
    for length in ("99999999999999999999999", "-1", "1x", ""):
        answer = server.raw((head + f"Content-Length: {length}\r\n\r\n{{}}").encode())
        assert answer[9:12] in (b"400", b"413", b"422", b""), (length, answer[:100])
    answer = server.raw((head + "Transfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n").encode())
    assert answer.startswith(b"HTTP/1.1 400"), answer[:100]
    for body in (b"", b"[", b"[1]", b"{}", b'{"values":{}}', b'{"values":1}', b"\xff\xfe", b"[" * 100000):
        assert server.post(path, body).status == 400, body[:20]
    assert server.get(API + "/status").status == 200


def test_ends_requests_that_never_end(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    header = socket.create_connection(("127.0.0.1", server.port), timeout=harness.DEADLINE_S)
    header.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\nX-Slow: ")
    body = socket.create_connection(("127.0.0.1", server.port), timeout=harness.DEADLINE_S)
    body.sendall(f"POST {API}/boards/{setting.node}/set HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000\r\n"
                 f"Authorization: Bearer {TOKEN}\r\nContent-Type: application/json\r\n\r\n".encode())
    begin = time.monotonic()
    for connection, expected in ((header, b""), (body, b"HTTP/1.1 408")):
        connection.settimeout(0.5)
        answer = None
        while answer is None and time.monotonic() < begin + harness.DEADLINE_S:
            try:
                connection.sendall(b"x")  # a byte now and then does not help
                answer = connection.recv(65536)
            except TimeoutError:
                pass
            except OSError:
                answer = b""
        assert answer is not None and answer.startswith(expected), answer
        connection.close()
    assert server.get(API + "/status").status == 200


def test_survives_garbage(setting):
    setting.start_node()
    server = setting.start_server()
    for data in (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(200), b"\0" * 5000, b"GET\r\n\r\n", b"\r\n" * 1000,
                 b"GET / HTTP/9.9\r\n\r\n", b"GET " + b"/a" * 50000 + b" HTTP/1.1\r\n\r\n",
                 b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 20000 + b"\r\n", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + bytes(100)):
        try:
            server.raw(data)
        except OSError:
            pass  # closed while we were sending
        assert server.get(API + "/status").status == 200, data[:30]


def test_a_board_goes_and_comes_back(setting):
    node = setting.start_node()
    server = setting.start_server()
    board = lambda: server.get(API + "/boards").json()["boards"][0]
    layout = board()["layout"]
    setting.end(node)
    wait_for(lambda: not board()["alive"], "the board to be gone")
    assert any("not running" in text for text in board()["trouble"])
    setting.start_node()
    wait_for(lambda: board()["alive"], "the board to be back")
    assert board()["layout"] == layout


def test_tells_what_modules_printed(setting):
    setting.start_node()
    server = setting.start_server()
    printed = lambda: server.get(f"{API}/boards/{setting.node}/messages").json()["messages"]
    wait_for(lambda: printed() != [], "a module to print")
    (one,) = printed()
    assert (one["who"], one["tick"], one["text"]) == ("modify", 43, "the gripper \x1b[31mis open"), one
    assert server.get(f"{API}/boards/{setting.node}/messages?count=0").status == 400


def test_no_board_at_all(setting):
    server = setting.start_server()
    assert server.get(API + "/boards").json() == {"boards": []}
    for path in ("", "/modules", "/variables", "/runs", "/forces", "/faults", "/schedule", "/overruns", "/messages"):
        assert server.get(f"{API}/boards/{setting.node}{path}").status == 404, path


def test_shows_the_arms_of_a_board(setting):
    (setting.folder / "arm.urdf").write_text("<robot name='arm'/>")
    (setting.folder / "huge.urdf").write_text("x" * (1 << 20) + "x")
    module = ("<module><filename>./{}.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>"
              "<period>1000000</period><priority>1</priority><property><value name='urdf'>{}</value></property></module>")
    files = {"modify": "arm.urdf", "output": "huge.urdf", "show": "none.urdf", "stranger": "arm.urdf"}
    (setting.folder / "module.xml").write_text(
        f"<root>{''.join(module.format(*pair) for pair in files.items())}</root>")
    setting.start_node("config", setting.folder / "module.xml")
    server = setting.start_server()
    answer = server.get(f"{API}/boards/{setting.node}/robots").json()
    (robot,) = answer["robots"]
    assert (robot["module"], robot["urdf"], robot["frames"]) == ("modify", "<robot name='arm'/>", []), answer
    assert robot["zones"] == robot["bodies"] == robot["workspace"] == [] and "arm.urdf" in robot["problem"], answer
    assert server.get(f"{API}/boards/missing/robots").status == 404


# Frames are resolved: the pallet is turned by 90 degrees about z.
ZONES = """FRAME pallet = POSE 400 200 50 RPY 0 0 90
KEEPOUT table = BOX -800 -800 -60 800 800 -10
KEEPOUT post = CYLINDER 0 700 0 0 700 900 RADIUS 60
KEEPOUT clamp = BOX 0 0 0 80 40 60 IN pallet
KEEPOUT lamp = BALL 500 0 900 RADIUS 100
TOOL gripper = POSE 0 0 120 RPY 0 0 0
BODY gripper = BOX -60 -30 0 60 30 90
"""


def test_shows_the_zones_of_a_robot(setting):
    shutil.copy(SOURCE / "examples/robot_cell/robot.urdf", setting.folder / "arm.urdf")
    jobs = setting.folder / "zones.job"
    jobs.write_text(ZONES)
    properties = {"urdf": "arm.urdf", "jobs": "zones.job", "workspace": "-900 -900 0 900 900 1500"}
    (setting.folder / "module.xml").write_text(
        "<root><module><filename>./modify.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>"
        "<period>1000000</period><priority>1</priority>"
        "<property>" + "".join(f"<value name='{name}'>{value}</value>" for name, value in properties.items())
        + "</property></module></root>")
    setting.start_node("config", setting.folder / "module.xml")
    server = setting.start_server()
    robot = lambda: server.get(f"{API}/boards/{setting.node}/robots").json()["robots"][0]
    found = robot()
    near = lambda one, kind, size, position, orientation: one["kind"] == kind and all(
        abs(a - b) < 1e-6 for a, b in zip(one["size"] + one["position"] + one["orientation"], size + position + orientation))
    zones = {one["name"]: one for one in found["zones"]}
    assert sorted(zones) == ["clamp", "lamp", "post", "table"], found
    assert near(zones["table"], "box", [1600, 1600, 50], [0, 0, -35], [0, 0, 0]), found
    assert near(zones["post"], "cylinder", [120, 120, 900], [0, 700, 450], [0, 0, 0]), found
    assert near(zones["clamp"], "box", [80, 40, 60], [380, 240, 80], [0, 0, 90]), found
    assert near(zones["lamp"], "ball", [200, 200, 200], [500, 0, 900], [0, 0, 0]), found
    (body,) = found["bodies"]
    assert (body["name"], body["tool"]) == ("gripper", 1) and near(body, "box", [120, 60, 90], [0, 0, 45], [0, 0, 0]), found
    assert found["workspace"] == [-900, -900, 0, 900, 900, 1500] and "problem" not in found, found
    jobs.write_text(ZONES + "pallet = pallet : POSE 1 0 0\n")
    found = robot()
    assert found["zones"] == [] and "'clamp' is in frame 'pallet', which jobs compute" in found["problem"], found


def test_a_scope_needs_what_it_can_read(setting):
    setting.start_node()
    server = setting.start_server()
    base = f"{API}/boards/{setting.node}/scope"
    assert "keeps no tape" in server.get(base + "?channel=tick").json()["message"]
    for wrong in ("?channel=tick&pre=x", "?channel=tick&pre=15000&post=15000", "?channel=tick&timeout_ms=99999",
                  "?channel=tick&after_tick=-1"):
        assert server.get(base + wrong).status == 400, wrong
    assert server.get(f"{API}/boards/missing/scope?channel=tick").status == 404


def openssl(setting, *words):
    subprocess.run(["openssl", *words], cwd=setting.folder, check=True, capture_output=True)


def make_certificate(setting, name, days=10, authority=None, signs=False):
    """NAME.key and NAME.pem, self-signed or signed by an authority. signs: it is an authority."""
    openssl(setting, "req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout", f"{name}.key",
            "-out", f"{name}.csr", "-subj", f"/CN={name}")
    signer = ["-CA", f"{authority}.pem", "-CAkey", f"{authority}.key", "-CAcreateserial"] if authority else [
        "-signkey", f"{name}.key"]
    if signs:
        (setting.folder / "signs.cnf").write_text("basicConstraints=critical,CA:TRUE\n")
        signer += ["-extfile", "signs.cnf"]
    openssl(setting, "x509", "-req", "-in", f"{name}.csr", "-out", f"{name}.pem", "-days", str(days), *signer)


def ask_tls(setting, port, path, certificate=None, token=None):
    context = ssl.create_default_context(cafile=setting.folder / "server.pem")
    context.check_hostname = False
    if certificate:
        context.load_cert_chain(setting.folder / f"{certificate}.pem", setting.folder / f"{certificate}.key")
    connection = http.client.HTTPSConnection("127.0.0.1", port, context=context, timeout=harness.DEADLINE_S)
    try:
        connection.request("GET", path, headers={"Authorization": f"Bearer {token}"} if token else {})
        answer = connection.getresponse()
        return answer.status, json.loads(answer.read())
    finally:
        connection.close()


def test_tls_and_client_certificates(setting):
    for name in ("server", "ca", "stranger"):
        make_certificate(setting, name, signs=name == "ca")
    make_certificate(setting, "deployer", authority="ca")
    make_certificate(setting, "late", days=0, authority="ca")  # ends in the second in which it begins
    server = setting.start_server("--write", "--bind", "0.0.0.0", "--cert", setting.folder / "server.pem", "--key",
                                  setting.folder / "server.key", "--client-ca", setting.folder / "ca.pem",
                                  "--token-file", setting.tokens)
    ask = lambda **more: ask_tls(setting, server.port, API + "/status", **more)
    assert ask()[0] == 401
    assert ask(token=TOKEN[:-1])[0] == 401
    status, body = ask(token=TOKEN)
    assert status == 200 and body["who"] == "ana" and body["may_write"]
    status, body = ask(certificate="deployer")
    assert status == 200 and body["who"] == "deployer" and body["may_write"], body
    for name in ("stranger", "late"):
        try:
            assert ask(certificate=name)[0] == 401, name
        except (OSError, http.client.HTTPException):
            pass  # turned away before a word was said
    try:
        assert server.get(API + "/status").status >= 400  # without TLS
    except (OSError, http.client.HTTPException):
        pass


def test_who_is_removed_from_the_list_gets_no_more_rights_by_a_certificate(setting):
    """IEC 62443-3-3, SR 1.3 and 2.1: the list, and not an authority that knows nothing of the plant, says who may write."""
    for name in ("server", "ca"):
        make_certificate(setting, name, signs=name == "ca")
    make_certificate(setting, "anna", authority="ca")
    users = setting.folder / "users.xml"

    def write(text):
        users.write_text(f"<users>{text}</users>")
        users.chmod(0o600)

    write('<user name="anna" role="operate"/>')
    server = setting.start_server("--write", "--bind", "0.0.0.0", "--cert", setting.folder / "server.pem", "--key",
                                  setting.folder / "server.key", "--client-ca", setting.folder / "ca.pem", "--users", users)
    role = lambda: ask_tls(setting, server.port, API + "/session", certificate="anna")[1]["role"]
    assert role() == "operate"
    write("")
    assert role() == "look"


def test_clients_turn_away_an_expired_certificate(setting):
    make_certificate(setting, "server", days=0)
    server = setting.start_server("--bind", "0.0.0.0", "--cert", setting.folder / "server.pem", "--key",
                                  setting.folder / "server.key", "--token-file", setting.tokens)
    for _ in range(3):  # it is still there for the next one
        try:
            ask_tls(setting, server.port, API + "/status", token=TOKEN)
            raise AssertionError("an expired certificate was taken")
        except ssl.SSLCertVerificationError as refused:
            assert "expired" in str(refused), refused
    assert server.child.poll() is None


def test_is_not_open_by_mistake(setting):
    for options in (["--bind", "0.0.0.0"], ["--bind", "0.0.0.0", "--write", "--token-file", setting.tokens],
                    ["--cert", "a.pem"], ["--client-ca", "a.pem"], ["--bind", "nonsense"], ["--bind", "192.0.2.1"]):
        done = subprocess.run([setting.programs / "indurop-serve", "--port", "0", *options], env=setting.environment,
                              capture_output=True, text=True, timeout=harness.DEADLINE_S, check=False)
        assert done.returncode in (1, 2) and "error:" in done.stderr, (options, done)
    setting.tokens.chmod(0o644)
    done = subprocess.run([setting.programs / "indurop-serve", "--port", "0", "--token-file", setting.tokens],
                          env=setting.environment, capture_output=True, text=True, timeout=harness.DEADLINE_S, check=False)
    assert done.returncode == 1 and "chmod 600" in done.stderr


def test_ends_on_a_signal(setting):
    server = setting.start_server()
    assert setting.end(server.child) == 143


if __name__ == "__main__":
    harness.main(globals())
