#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Who may do what over OPC UA: users of `indurop serve` with their roles, its journal, tokens, anonymous clients, encrypted
connections. roles_test.py PROGRAMS FAKE_NODE [TEST...]"""

from opcua_harness import API, Client, harness, main, refused, wait_for
from users_test import entries, PASSWORD, sign_in, user, Users

SECURE = {"mode": "SignAndEncrypt", "policy": "Basic256Sha256"}


def begin(setting, *options, real=False, **users):
    setting.start_real_node() if real else setting.start_node()
    server = setting.start_server("--write", "--users", Users(setting, **users).file, "--audit", setting.folder / "audit.jsonl")
    return server, setting.start_opcua(server, *options)


def value_of(server, setting, name):
    return server.get(f"{API}/boards/{setting.node}/variables/{name}").json()["value"]


def test_a_write_needs_the_role_and_names_the_user(setting):
    server, endpoint = begin(setting, "--anonymous", anna=user("operate"), leo=user("look"))
    gain = setting.id("knu::Robot::gain")
    anna = setting.client(endpoint, user="anna", password=PASSWORD, **SECURE)
    assert anna.do("write", node=gain, type="Double", value=2.5) == "Good"
    assert value_of(server, setting, "gain") == 2.5
    done = [one for one in entries(setting) if one["action"] == "set" and one["outcome"] == "done"]
    assert done and done[-1]["who"] == "anna" and done[-1]["reason"] == "OPC UA", done
    assert anna.do("write", node=gain, type="Double", value=11) == "BadOutOfRange"
    assert anna.do("write", node=gain, type="Int32", value=1) == "BadTypeMismatch"
    leo = setting.client(endpoint, user="leo", password=PASSWORD, **SECURE)
    anonymous = setting.client(endpoint)
    for client in (leo, anonymous):
        assert client.read(gain)["value"] == 2.5
        assert client.do("write", node=gain, type="Double", value=3) == "BadUserAccessDenied"
        assert client.read(gain, attribute="UserAccessLevel")["value"] == 5, "shown as one to read only, now and in the past"
    assert anna.read(gain, attribute="UserAccessLevel")["value"] == 7
    assert value_of(server, setting, "gain") == 2.5
    log = setting.log.read_text()
    assert "the write of leo was refused: " in log and "operate" in log and "the write of anonymous was refused" in log, log
    assert any(one["who"] == "leo" and one["action"] == "refused" for one in entries(setting)), "the server has it in its journal"
    assert PASSWORD not in log


def test_values_of_every_kind_are_written(setting):
    server, endpoint = begin(setting, real=True, paul=user("program"))
    client = setting.client(endpoint, user="paul", password=PASSWORD, **SECURE)
    cases = [("flag", "Boolean", False, False), ("tiny", "SByte", -128, -128), ("byte", "Byte", 255, 255), ("word", "UInt16", 1, 1),
             ("small", "Int16", -1, -1), ("whole", "Int32", 7, 7), ("natural", "UInt32", 4294967295, 4294967295),
             ("wide", "Int64", [0xFFFFFFFF, 0xFFFFFFFE], -2), ("huge", "UInt64", [1, 0], 4294967296),
             ("single", "Float", -0.25, -0.25), ("precise", "Double", 1e-300, 1e-300), ("letter", "Byte", 65, "A"),
             ("text", "String", 'a "b" \\ \n', 'a "b" \\ \n'), ("mode", "Int32", 1, "AUTO")]
    for name, kind, value, seen in cases:
        node = setting.id(f"every::{name}")
        assert client.do("write", node=node, type=kind, value=value) == "Good", (name, setting.log.read_text())
        assert value_of(server, setting, f"every::{name}") == seen, name
        wait_for(lambda: client.read(node)["value"] == value, f"{name} to be read again")
    assert client.do("write", node=setting.id("every::numbers"), type="Int32", value=[1, 2, 3, 4], array=True) == "Good"
    assert client.do("write", node=setting.id("every::numbers"), type="Int32", value=[8, 9], array=True, range="1:2") == "Good"
    assert value_of(server, setting, "every::numbers") == [1, 8, 9, 4]
    assert client.do("write", node=setting.id("every::numbers"), type="Int32", value=[1, 2], array=True) == "BadTypeMismatch"
    assert client.do("write", node=setting.id("every::numbers"), type="Int32", value=1) == "BadTypeMismatch"
    assert client.do("write", node=setting.id("every::matrix"), type="Double", value=[1, 2, 3, 4, 5, 6], dims=[2, 3]) == "Good"
    assert value_of(server, setting, "every::matrix") == [[1, 2, 3], [4, 5, 6]]
    point = setting.id("every::point")
    assert client.do("change", node=point, fields={"x": -2.5, "name": "left", "mode": 0, "grid": [6, 5, 4, 3, 2, 1]}) == "Good", setting.log.read_text()
    assert value_of(server, setting, "every::point") == {
        "x": -2.5, "y": 0, "valid": True, "name": "left", "grid": [[6, 5, 4], [3, 2, 1]], "mode": "OFF"}
    assert client.do("change", node=point, fields={"x": 11}) == "BadOutOfRange"
    assert client.do("write", node=setting.id("every::point.x"), type="Double", value=9) == "Good"
    assert value_of(server, setting, "every::point")["x"] == 9
    assert client.do("write", node=setting.id("every::text"), type="String", value="x" * 99) == "BadOutOfRange"


def test_who_may_not_enter(setting):
    _, endpoint = begin(setting, anna=user("operate"))
    client = Client(setting, endpoint)
    offered = client.do("endpoints", url=endpoint)
    assert {kind for one in offered for kind in one["users"]} == {"UserName"}, offered
    refused(client.connect)
    assert "Bad" in refused(lambda: client.connect(user="anna", password="wrong", **SECURE))
    assert "Bad" in refused(lambda: client.connect(user="eve", password=PASSWORD, **SECURE))
    assert "Bad" in refused(lambda: client.connect(user="no\nbody\x1b[2J", password=PASSWORD, **SECURE))
    client.connect(user="anna", password=PASSWORD, mode="SignAndEncrypt", policy="Aes128_Sha256_RsaOaep")
    assert client.read(setting.id("knu::Robot::gain"))["code"] == "Good"
    log = setting.log.read_text()
    assert "'eve' cannot sign in" in log and "'no?body?[2J' cannot sign in" in log, "a name forges no line of the log"


def test_a_user_who_is_removed_is_out(setting):
    users = {"anna": user("operate"), "ada": user("administer")}
    server, endpoint = begin(setting, **users)
    client = setting.client(endpoint, user="anna", password=PASSWORD, **SECURE)
    gain = setting.id("knu::Robot::gain")
    assert client.do("write", node=gain, type="Double", value=2) == "Good"
    Users(setting, ada=user("administer"))
    assert client.do("write", node=gain, type="Double", value=3) == "BadUserAccessDenied"
    wait_for(lambda: "the session of anna has ended" in setting.log.read_text(), "the session to end")
    assert value_of(server, setting, "gain") == 2


def test_sessions_end_at_the_server_with_those_of_clients(setting):
    server, endpoint = begin(setting, anna=user("operate"), ada=user("administer"))
    ada = sign_in(server, "ada")
    open_sessions = lambda: {one["user"]: len(one["sessions"]) for one in
                             server.get(f"{API}/users", Authorization=f"Bearer {ada}").json()["users"]}["anna"]
    client = setting.client(endpoint, user="anna", password=PASSWORD, **SECURE)
    assert open_sessions() == 1
    client.do("close")
    wait_for(lambda: open_sessions() == 0, "the session to end")


def test_without_users_a_token_is_the_password(setting):
    setting.start_node()
    setting.tokens.write_text(setting.tokens.read_text() + "guest a-token-to-look-around-0123456789 look\n")
    server = setting.start_server("--write", "--token-file", setting.tokens)
    endpoint = setting.start_opcua(server)
    gain = setting.id("knu::Robot::gain")
    ana = setting.client(endpoint, user="ana", password=harness.TOKEN, **SECURE)
    assert ana.do("write", node=gain, type="Double", value=4) == "Good"
    guest = setting.client(endpoint, user="guest", password="a-token-to-look-around-0123456789", **SECURE)
    assert guest.do("write", node=gain, type="Double", value=5) == "BadUserAccessDenied"
    client = Client(setting, endpoint)
    assert "Bad" in refused(lambda: client.connect(user="guest", password=harness.TOKEN, **SECURE)), "the token of another"


if __name__ == "__main__":
    main(globals())
