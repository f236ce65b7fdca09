#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Users of indurop-serve: passwords that Python's hashlib hashed, roles, limits to boards and variables, sessions that end,
and what the audit log says. users_test.py PROGRAMS FAKE_NODE [TEST...]"""

import contextlib
import hashlib
import http.client
import itertools
import json
import os
import resource
import signal
import socket
import ssl
import subprocess
import threading
import time

import harness
from harness import wait_for
from websocket import WebSocket

API = "/api/v1"
PASSWORD = "correct horse"
ROLES = ("look", "operate", "tune", "program", "administer")


def hash_of(password, salt=None, cost=10):
    """As users.xml keeps it; cheap, because these tests sign in often."""
    salt = salt or os.urandom(16)
    hashed = hashlib.scrypt(password.encode(), salt=salt, n=2**cost, r=8, p=1, dklen=32, maxmem=2**27)
    return f"scrypt:{cost}:8:1:" + salt.hex() + ":" + hashed.hex()


@contextlib.contextmanager
def threads_of(work, number):
    """Threads that repeat `work` until the block ends."""
    ended = threading.Event()

    def repeat():
        while not ended.is_set():
            work()

    threads = [threading.Thread(target=repeat) for _ in range(number)]
    for thread in threads:
        thread.start()
    try:
        yield
    finally:
        ended.set()
        for thread in threads:
            thread.join()


class Users:
    def __init__(self, setting, **users):
        self.file = setting.folder / "users.xml"
        self.write(**users)

    def write(self, **users):
        text = "".join(f'<user name="{name}" {attributes}/>' for name, attributes in users.items())
        fresh = self.file.with_suffix(".new")
        fresh.write_text(f"<users>{text}</users>")
        fresh.chmod(0o640)
        fresh.rename(self.file)


def user(role, more="", password=PASSWORD):
    return f'role="{role}" password="{hash_of(password)}" {more}'


def sign_in(server, name, password=PASSWORD):
    answer = server.post(f"{API}/session", {"user": name, "password": password}, token=None)
    return answer.json().get("token") if answer.status == 200 else None


def entries(setting):
    path = setting.folder / "audit.jsonl"
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def serve(setting, users, *options):
    return setting.start_server("--write", "--users", users.file, "--audit", setting.folder / "audit.jsonl", *options)


def test_each_role_does_what_it_may(setting):
    setting.start_node()
    users = Users(setting, **{role: user(role) for role in ROLES})
    server = serve(setting, users)
    board = f"{API}/boards/{setting.node}"
    requests = [  # the least role, and what it asks
        ("look", "GET", f"{API}/boards", None),
        ("operate", "POST", f"{board}/set", {"values": {"gain": 2.5}}),
        ("tune", "POST", f"{board}/force", {"values": {"gain": 1.5}, "for_ns": 1_000_000_000}),
        ("program", "POST", f"{board}/lock", {"lock": "none"}),
        ("administer", "GET", f"{API}/users", None),
    ]
    for role in ROLES:
        token = sign_in(server, role)
        assert token, role
        for least, method, path, body in requests:
            answer = server.ask(method, path, body, token)
            allowed = ROLES.index(role) >= ROLES.index(least)
            # A force of the test before may still hold the variable: that is no question of rights.
            assert answer.status != 403 if allowed else answer.status == 403, (role, path, answer.status, answer.body)
        who = server.get(f"{API}/session", Authorization=f"Bearer {token}").json()
        assert who == {"user": role, "role": role, "boards": [], "variables": []}, who
    refused = [entry for entry in entries(setting) if entry["action"] == "refused"]
    assert any(entry["who"] == "look" and entry["what"].endswith("/set") and "needs the role operate" in entry["outcome"]
               for entry in refused), refused
    assert any(entry["who"] == "operate" and entry["action"] == "set" and entry["outcome"] == "done"
               for entry in entries(setting))


def test_wrong_passwords_are_refused_slowly_and_logged(setting):
    users = Users(setting, anna=user("operate"))
    server = serve(setting, users)
    for name, password in [("anna", "wrong"), ("eve", PASSWORD), ("anna", ""), ("", "")]:
        answer = server.post(f"{API}/session", {"user": name, "password": password}, token=None)
        assert answer.status == 401 and answer.json()["message"] == "the user or the password is wrong", answer.body
    begin = time.monotonic()
    for _ in range(3):
        assert sign_in(server, "anna", "wrong") is None
    assert time.monotonic() - begin > 1.5, "guesses are delayed"
    assert sign_in(server, "anna"), "the right one is still accepted"
    assert any(entry["action"] == "refused" and "anna" in entry["outcome"] for entry in entries(setting))
    for body in ("", "{}", "[]", '{"user": 1, "password": 2}', '{"user": "anna"}'):
        assert server.post(f"{API}/session", body, token=None).status == 400, body
    text = (setting.folder / "audit.jsonl").read_text()
    assert "wrong\"" not in text and PASSWORD not in text, "passwords are in no log"


def test_guesses_of_many_connections_do_not_lock_others_out(setting):
    """Each guess costs the server as much as with indurop users, and their clients do not wait for the refusal."""
    slow = f'role="operate" password="{hash_of(PASSWORD, cost=15)}"'
    server = serve(setting, Users(setting, anna=slow, ada=slow))
    refused, guesses = threading.Semaphore(0), itertools.count()

    def guess():
        name = ("ada", f"stranger{next(guesses)}")[next(guesses) % 2]
        connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=0.5)
        try:
            connection.request("POST", f"{API}/session", json.dumps({"user": name, "password": "a wrong one"}),
                               {"Content-Type": "application/json"})
            if connection.getresponse().status == 503:
                refused.release()
        except OSError:
            pass
        finally:
            connection.close()

    with threads_of(guess, 40):
        for _ in range(100):
            assert refused.acquire(timeout=harness.DEADLINE_S), "more guesses than the server verifies"
        for _ in range(5):
            assert sign_in(server, "anna"), "another user signs in meanwhile, even from the same address"
    wait_for(lambda: sign_in(server, "ada"), "the one whose password was guessed to sign in again")


def test_a_flood_of_requests_keeps_no_refusal_out_of_the_log(setting):
    setting.start_node()
    server = serve(setting, Users(setting, anna=user("operate"), eve=user("look")))
    anna, eve = sign_in(server, "anna"), sign_in(server, "eve")
    board = f"{API}/boards/{setting.node}"
    keep = f"POST {board}/jog/none/keep HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: Bearer {anna}\r\n\r\n".encode()

    def flood():
        connections = [socket.create_connection(("127.0.0.1", server.port), timeout=harness.DEADLINE_S) for _ in range(50)]
        for connection in connections:
            connection.sendall(keep)
        for connection in connections:
            connection.recv(4096)
            connection.close()

    with threads_of(flood, 2):
        for _ in range(20):
            assert server.post(f"{board}/lock", {"lock": "none"}, eve).status == 403
    wait_for(lambda: sum(entry["who"] == "eve" and entry["action"] == "refused" for entry in entries(setting)) == 20,
             "an entry for each refusal")


def test_limits_to_boards_and_variables(setting):
    setting.start_node()
    node = setting.node
    users = Users(setting, here=user("administer", f'boards="{node}"'), there=user("administer", 'boards="other*"'),
                  gain=user("administer", 'variables="gain"'), glob=user("program", 'variables="test::*"'))
    server = serve(setting, users)
    board = f"{API}/boards/{node}"
    tokens = {name: sign_in(server, name) for name in ("here", "there", "gain", "glob")}
    values = {"values": {"gain": 2.5}}
    assert server.post(f"{board}/set", values, tokens["here"]).status == 200
    refused = server.post(f"{board}/set", values, tokens["there"])
    assert refused.status == 403 and "other*" in refused.json()["message"], refused.body
    assert server.get(board, Authorization=f"Bearer {tokens['there']}").status == 200, "all may look"
    full = server.post(f"{board}/set", values, tokens["here"]).json()["written"][0]
    users.write(part=user("program", f'variables="{full}"'), none=user("program", 'variables="another::*"'))
    part, none = sign_in(server, "part"), sign_in(server, "none")
    assert server.post(f"{board}/set", values, part).status == 200, "its short name stands for the full one"
    assert server.post(f"{board}/set", values, none).status == 403
    others = [one["name"] for one in server.get(f"{board}/variables", Authorization=f"Bearer {part}").json()["variables"]
              if one["name"] != full]
    assert others, "the node has further variables"
    answer = server.post(f"{board}/set", {"values": {"gain": 1, others[0]: 1}}, part)
    assert answer.status in (403, 422), answer.body
    for path, body in ((f"{board}/lock", {"lock": "none"}), (f"{board}/release", {"all": True})):
        answer = server.post(path, body, part)
        assert answer.status == 403 and full in answer.json()["message"], (path, answer.body)
    assert any(entry["who"] == "none" and entry["action"] == "set" and "only" in entry["outcome"]
               for entry in entries(setting))


def test_a_change_of_the_list_counts_at_once(setting):
    setting.start_node()
    hashed = hash_of(PASSWORD)
    users = Users(setting, anna=f'role="tune" password="{hashed}"')
    server = serve(setting, users)
    token = sign_in(server, "anna")
    board = f"{API}/boards/{setting.node}"
    held = server.post(f"{board}/force", {"values": {"gain": 4.5}, "lease": True}, token)
    assert held.status == 200, held.body
    lease = held.json()["lease"]
    assert server.post(f"{board}/leases/{lease}/renew", None, token).status == 200
    users.write(anna=f'role="tune" password="{hashed}" variables="another::*"')
    assert server.post(f"{board}/leases/{lease}/renew", None, token).status == 404, "she may not change this variable"
    wait_for(lambda: not server.get(f"{board}/forces").json()["forces"], "the force to end with the right to it")
    assert any("may no longer change" in entry["outcome"] for entry in entries(setting))
    users.write(anna=f'role="tune" password="{hashed}"')
    lease = server.post(f"{board}/force", {"values": {"gain": 4.5}, "lease": True}, token).json()["lease"]
    users.write(anna=f'role="operate" password="{hashed}"')
    assert server.post(f"{board}/leases/{lease}/renew", None, token).status == 403, "she may not force any more"
    wait_for(lambda: not server.get(f"{board}/forces").json()["forces"], "the force to end with its lease")
    users.write(bob=user("look"))
    answer = server.post(f"{board}/set", {"values": {"gain": 1}}, token)
    assert answer.status == 401 and "session has ended" in answer.json()["message"], answer.body


def test_a_right_that_is_lost_while_the_body_arrives_counts(setting):
    """The headers of a request are checked first; its body may take seconds."""
    setting.start_node("robot")
    hashed, other = hash_of(PASSWORD), hash_of("another one")
    board = f"{API}/boards/{setting.node}"
    requests = [("set", {"values": {"gain": 7.5}}), ("force", {"values": {"gain": 7.5}}), ("release", {"all": True}), ("lock", {"lock": "all"}),
                ("jog", {"robot": "arm", "frame": "base", "speed": [0, 0, 25]}), ("alarms/ack", {"all": True}),
                ("recipes/seven/save", {"comment": "a"})]
    changes = [("its role", f'role="look" password="{hashed}"', 403), ("its variables", f'role="program" password="{hashed}" variables="x::*"', 403),
               ("its boards", f'role="program" password="{hashed}" boards="x"', 403), ("its password", f'role="program" password="{other}"', 401),
               ("all", "", 401)]
    users = Users(setting, anna=f'role="program" password="{hashed}"')
    server = serve(setting, users)
    for path, body in requests:
        for what, after, status in changes if path == "set" else changes[:3]:  # replies with 401 are delayed
            users.write(anna=f'role="program" password="{hashed}"')
            token = sign_in(server, "anna")
            sent = json.dumps(body).encode()
            head = (f"POST {board}/{path} HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {token}\r\nConnection: close\r\n"
                    f"Content-Type: application/json\r\nContent-Length: {len(sent)}\r\nExpect: 100-continue\r\n\r\n")
            with socket.create_connection(("127.0.0.1", server.port), timeout=harness.DEADLINE_S) as connection:
                connection.sendall(head.encode())
                assert connection.recv(4096).startswith(b"HTTP/1.1 100 "), "the headers are accepted"
                users.write(**({"anna": after} if after else {"bob": user("look")}))
                connection.sendall(sent)
                answer = connection.recv(4096)
            assert answer.startswith(f"HTTP/1.1 {status} ".encode()), (path, what, answer)
    assert not [one for one in entries(setting) if one["outcome"] in ("begun", "done") and one["action"] != "sign in"], "nothing was done"


def test_neither_a_stream_nor_what_a_page_requests_on_its_own_is_use_of_a_session(setting):
    setting.start_node()
    server = serve(setting, Users(setting, anna=user("operate"), ada=user("administer")))
    anna, ada = sign_in(server, "anna"), sign_in(server, "ada")

    def idle_s():
        listed = server.get(f"{API}/users", Authorization=f"Bearer {ada}").json()["users"]
        return next(one["sessions"][0]["idle_ns"] for one in listed if one["user"] == "anna") / 1e9

    begin = time.monotonic()
    stream = WebSocket(server.port, protocols=("indurop.v1", f"indurop.token.{anna}"))
    stream.say(type="subscribe", id=1, names=["tick"], rate_hz=1)
    while time.monotonic() - begin < 16:  # it checks a stream each 15 s
        stream.heard("values")
        assert server.get(f"{API}/status", Authorization=f"Bearer {anna}", Indurop_Background="true").status == 200
    stream.close()
    assert idle_s() >= 16
    assert server.get(f"{API}/status", Authorization=f"Bearer {anna}").status == 200
    assert idle_s() < 8, "a request of its user is"


def test_sessions_are_ended_by_who_has_them_and_by_administrators(setting):
    users = Users(setting, anna=user("operate"), ada=user("administer"))
    server = serve(setting, users)
    first, second, ada = sign_in(server, "anna"), sign_in(server, "anna"), sign_in(server, "ada")
    assert server.post(f"{API}/session/end", None, first).json() == {"ended": True}
    assert server.get(f"{API}/session", Authorization=f"Bearer {first}").status == 401
    assert server.post(f"{API}/users/anna/end", None, second).status == 403
    listed = {one["user"]: one for one in server.get(f"{API}/users", Authorization=f"Bearer {ada}").json()["users"]}
    assert len(listed["anna"]["sessions"]) == 1 and listed["anna"]["sessions"][0]["from"] == "127.0.0.1", listed
    assert server.post(f"{API}/users/anna/end", None, ada).json() == {"user": "anna", "ended": 1}
    assert server.get(f"{API}/session", Authorization=f"Bearer {second}").status == 401
    assert server.get(f"{API}/session", Authorization=f"Bearer {ada}").status == 200


def test_the_command_line_makes_the_list(setting):
    def indurop(*words, code=0, text=""):
        done = subprocess.run([str(setting.programs / "indurop"), "users", *words, "--file", str(setting.folder / "u.xml")],
                              input=text, capture_output=True, text=True, env=setting.environment, check=False)
        assert done.returncode == code, (words, done.returncode, done.stdout, done.stderr)
        return done.stdout, done.stderr

    indurop("add", "anna", "--role", "administer", text="long enough\n")
    indurop("add", "ben", "--role", "operate", "--boards", "press*,table", "--variables", "cell::*", text="another one\n")
    indurop("add", "log.ger", "--role", "look", "--no-password")
    token = indurop("token", "log.ger")[0].strip()
    listed = json.loads(indurop("list", "-o", "json")[0])["users"]
    assert [(one["user"], one["role"], one["boards"], one["signs_in_with"]) for one in listed] == [
        ("anna", "administer", [], ["password"]), ("ben", "operate", ["press*", "table"], ["password"]),
        ("log.ger", "look", [], ["token"])], listed
    text = (setting.folder / "u.xml").read_text()
    assert "long enough" not in text and token not in text
    assert (setting.folder / "u.xml").stat().st_mode & 0o007 == 0, "others cannot read it"
    users = Users(setting)
    users.file = setting.folder / "u.xml"
    server = serve(setting, users)
    assert sign_in(server, "anna", "long enough") and sign_in(server, "ben", "another one")
    assert server.get(f"{API}/session", Authorization=f"Bearer {token}").json()["user"] == "log.ger"
    indurop("password", "anna", text="yet another\n")
    assert sign_in(server, "anna", "long enough") is None
    assert sign_in(server, "anna", "yet another")
    indurop("role", "ben", "look")
    assert json.loads(indurop("list", "-o", "json")[0])["users"][1]["boards"] == ["press*", "table"]
    indurop("role", "ben", "look", "--no-limits")
    assert json.loads(indurop("list", "-o", "json")[0])["users"][1]["boards"] == []
    indurop("remove", "anna")
    assert sign_in(server, "anna", "yet another") is None
    before = (setting.folder / "u.xml").read_bytes()
    for words, code, said in ((("add", "ben", "--role", "look"), 1, "there is a user 'ben' already"),
                              (("add", "b n", "--role", "look"), 2, "is not a valid user name"),
                              (("add", "eve", "--role", "boss"), 2, "boss"),
                              (("add", "eve", "--role", "look"), 1, "a password has 8 to 200 characters"),
                              (("remove", "bne"), 1, "ben"), (("password", "eve"), 1, "there is no user")):
        assert said in indurop(*words, code=code, text="short\n")[1], (words, said)
    assert (setting.folder / "u.xml").read_bytes() == before, "what fails changes nothing"
    (setting.folder / "u.xml").write_text("<users>\n<user name='x' role='boss'/></users>")
    assert "u.xml:2:" in indurop("list", code=4)[1]


def test_changes_of_the_list_at_the_same_time_are_all_kept(setting):
    file = setting.folder / "u.xml"

    def start(*words):
        return setting.start(setting.programs / "indurop", "users", *words, "--file", file, stderr=subprocess.PIPE)

    names = [f"user{number}" for number in range(24)]
    adding = [start("add", name, "--role", "look", "--no-password") for name in names]
    assert [child.wait(harness.DEADLINE_S) for child in adding] == [0] * len(names)
    listed = [line.split('"')[1] for line in file.read_text().splitlines() if "<user " in line]
    assert sorted(listed) == sorted(names), listed


def test_nothing_is_said_of_a_change_that_could_not_be_saved(setting):
    users = Users(setting, anna=user("operate"))
    before = users.file.read_bytes()

    def no_room():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

    for words in (["remove", "anna"], ["role", "anna", "look"], ["token", "anna"], ["password", "anna"],
                  ["add", "eve", "--role", "look", "--no-password"]):
        done = subprocess.run([str(setting.programs / "indurop"), "users", *words, "--file", str(users.file)],
                              input="long enough\n", capture_output=True, text=True, env=setting.environment,
                              preexec_fn=no_room, check=False)
        assert done.returncode == 1 and "cannot write" in done.stderr and done.stdout == "", (words, done)
    assert users.file.read_bytes() == before


def test_sessions_are_not_ended_without_an_entry_in_the_log(setting):
    server = serve(setting, Users(setting, anna=user("operate"), ada=user("administer")))
    anna, ada = sign_in(server, "anna"), sign_in(server, "ada")
    (setting.folder / "audit.jsonl").unlink()
    (setting.folder / "audit.jsonl").symlink_to("/dev/full")
    answer = server.post(f"{API}/users/anna/end", None, ada)
    assert answer.status == 500 and "No space left" in answer.json()["message"], answer.body
    assert server.get(f"{API}/session", Authorization=f"Bearer {anna}").status == 200


def test_tls_by_the_authority_of_the_plant(setting):
    def keys(*words, code=0):
        done = subprocess.run([str(setting.programs / "indurop"), "keys", *words], cwd=setting.folder, capture_output=True,
                              text=True, env=setting.environment, check=False)
        assert done.returncode == code, (words, done.returncode, done.stdout, done.stderr)
        return done.stdout + done.stderr

    (setting.folder / "plant.xml").write_text('<plant name="cell"><board name="drive"></board></plant>')
    keys("init", "plant.xml", "--dir", "keys")
    keys("server", "desk", "--dir", "keys", "--host", "127.0.0.1", "cell.local", "*.desk.local")
    folder = setting.folder / "keys" / "servers" / "desk"
    assert (folder / "server.key").stat().st_mode & 0o077 == 0
    users = Users(setting, anna=user("operate"))
    server = serve(setting, users, "--cert", folder / "server.pem", "--key", folder / "server.key", "--client-ca",
                   setting.folder / "keys" / "ca.pem")
    trusting = ssl.create_default_context(cafile=str(folder / "ca.pem"))

    def reach(name, context=trusting):
        with socket.create_connection(("127.0.0.1", server.port), timeout=harness.DEADLINE_S) as raw:
            with context.wrap_socket(raw, server_hostname=name) as secure:
                secure.sendall(b"GET /api/v1/session HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
                received = b""
                while part := secure.recv(4096):
                    received += part
                return received

    for name in ("127.0.0.1", "cell.local", "b.desk.local"):
        assert b'"role":"unknown"' in reach(name), name
    for name in ("127.0.0.2", "other.local", "desk.local"):
        try:
            reach(name)
        except ssl.SSLCertVerificationError:
            continue
        raise AssertionError(f"{name} is no name of this server")
    as_client = ssl.create_default_context(cafile=str(folder / "ca.pem"))
    as_client.load_cert_chain(folder / "server.pem", folder / "server.key")
    try:
        assert b'"role":"unknown"' in reach("127.0.0.1", as_client), "a server's certificate is no client's"
    except (ssl.SSLError, ConnectionError):  # what ends it first: the alert or the end of the connection
        pass
    before = (folder / "server.key").read_bytes(), (folder / "server.pem").read_bytes()
    keys("server", "desk", "--dir", "keys", "--host", "127.0.0.1")
    assert (folder / "server.key").read_bytes() == before[0] and (folder / "server.pem").read_bytes() != before[1]
    for host in ("a b", "https://cell", "-x", "cell,local"):
        assert "is neither an address nor a name" in keys("server", "other", "--dir", "keys", "--host", host, code=2), host
    assert not (setting.folder / "keys" / "servers" / "other").exists()


def test_a_wrong_list_is_said_at_the_start(setting):
    users = Users(setting, anna='role="boss"')
    done = subprocess.run([str(setting.programs / "indurop-serve"), "--port", "0", "--users", str(users.file)],
                          capture_output=True, text=True, env=setting.environment, timeout=harness.DEADLINE_S, check=False)
    assert done.returncode == 1 and "users.xml:1:" in done.stderr and "'boss' is none of" in done.stderr, done


if __name__ == "__main__":
    harness.main(globals())
