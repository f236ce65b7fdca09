#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plain topics of indurop-mqtt as mosquitto's clients meet them; values are compared with those of the server.
plain_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import signal
import subprocess

from mqtt_harness import API, TOKEN, main, wait_for

BEN = TOKEN[::-1]


def test_values_are_those_of_the_server(setting):
    setting.start_node()
    server = setting.start_server()
    setting.start_broker()
    setting.start_door(server, "--rate", 20)
    client = setting.subscribe("indurop/#")
    base = f"indurop/{setting.node}"
    variables = server.get(f"{API}/boards/{setting.node}/variables").json()["variables"]
    topic = lambda one: f"{base}/values/{one['name'].replace('::', '/')}"
    wait_for(lambda: all(client.last(topic(one)) for one in variables), "all values")
    assert len(variables) > 5
    for one in variables:
        got = json.loads(client.last(topic(one)))
        assert got.keys() == {"value", "unit", "quality", "forced", "time_ns", "wall_ns"}, got
        assert got["unit"] == one["unit"] and got["quality"] == "good" and not got["forced"], got
        if one["name"] not in ("knu::Robot::tick", "knu::Robot::joints"):  # which change all the time
            assert got["value"] == one["value"], (got, one)
    ticks = topic({"name": "knu::Robot::tick"})
    wait_for(lambda: len(client.all(ticks)) > 10, "changes")
    values = [json.loads(payload)["value"] for _, payload, _ in client.all(ticks)]
    times = [json.loads(payload)["time_ns"] for _, payload, _ in client.all(ticks)]
    assert values == sorted(values) and times == sorted(times), (values, times)
    assert len(client.all(topic({"name": "knu::Robot::gain"}))) == 1, "a value that does not change is sent once"
    assert client.last("indurop/online") == b"true" and client.last(base + "/alive") == b"true"


def test_selected_values_with_a_deadband(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    setting.start_broker()
    client = setting.subscribe("p/#")
    # What is not retained and does not change again is seen only by who is there.
    wait_for(lambda: setting.publish("p/there", "") or client.all("p/there"), "the subscription")
    setting.start_door(server, "--variables", "gain", "--variables", "press::*", "--deadband", "*gain=1", "--topic", "p", "--no-retain")
    topic = f"p/{setting.node}/values/knu/Robot/gain"
    set_gain = lambda value: server.post(f"{API}/boards/{setting.node}/set", {"values": {"gain": value, "press::oil": value}})
    oil = f"p/{setting.node}/values/press/oil"
    for value in (1.5, 1.9, 3, 3.5):
        wait_for(lambda: client.last(f"p/{setting.node}/alive"), "the board")
        assert set_gain(value).status == 200
        client.becomes(oil, lambda one, value=value: one["value"] == value, "the other value")
    assert client.last(topic) is not None
    assert [json.loads(payload)["value"] for _, payload, _ in client.all(topic) if json.loads(payload)["value"] != 1] == [3]
    assert {name for name, _, _ in client.all()} == {topic, oil, f"p/{setting.node}/values/press/door_open", "p/online",
                                                     f"p/{setting.node}/alive", "p/there"}
    assert not any(retained for name, _, retained in client.all() if "/values/" in name)


def start_door_with_users(setting, server):
    (setting.folder / "password").write_text("door\n")
    setting.door = setting.start_door(server, "--token-file", setting.tokens, "--broker-user", "door", "--broker-password-file",
                                      setting.folder / "password")


def start_with_users(setting):
    """Users at the server, and the same names at the broker, which may command in their own name only."""
    setting.start_node()
    setting.tokens.write_text(f"reader {TOKEN}r look\nana {TOKEN} operate\nben {BEN} look\n")
    server = setting.start_server("--write", "--token-file", setting.tokens)
    (setting.folder / "passwords").write_text("ana:ana\nben:ben\ndoor:door\n")
    subprocess.run(["mosquitto_passwd", "-U", setting.folder / "passwords"], check=True)
    (setting.folder / "acl").write_text("user door\ntopic readwrite indurop/#\n\npattern read indurop/#\npattern write indurop/+/set/%u/#\n")
    setting.broker_lines = ["allow_anonymous false", f"password_file {setting.folder}/passwords", f"acl_file {setting.folder}/acl"]
    setting.start_broker()
    start_door_with_users(setting, server)
    setting.client = ["-u", "ana", "-P", "ana"]
    client = setting.subscribe("indurop/#")
    wait_for(lambda: client.last(f"indurop/{setting.node}/values/knu/Robot/gain"), "values")
    return server, client


def test_commands_have_the_role_of_their_user(setting):
    server, client = start_with_users(setting)
    base = f"indurop/{setting.node}"
    answers = base + "/answer/ana"
    setting.publish(f"{base}/set/ana", json.dumps({"id": 1, "values": {"gain": 2.5, "mode": "AUTO"}, "reason": "shift"}))
    done = client.becomes(answers, lambda one: one["id"] == 1, "the answer")
    assert done["done"] and done["written"] == ["knu::Robot::gain", "knu::Robot::mode"], done
    client.becomes(base + "/values/knu/Robot/gain", lambda one: one["value"] == 2.5, "the value")
    setting.publish(f"{base}/set/ana/knu/Robot/gain", "3.5")
    client.becomes(base + "/values/knu/Robot/gain", lambda one: one["value"] == 3.5, "the value")
    setting.publish(f"{base}/set/ana/knu/Robot/joints[1].y", "190")  # its range ends at 180
    refused = client.becomes(answers, lambda one: not one["done"], "the refusal")
    assert refused["error"] == "wrong_value" and "180" in refused["message"], refused
    setting.client = ["-u", "ben", "-P", "ben"]
    setting.publish(f"{base}/set/ben/knu/Robot/gain", "4")
    refused = client.becomes(base + "/answer/ben", lambda one: True, "the refusal")
    assert refused["error"] == "forbidden" and not refused["done"], refused
    # The broker's list does not let ben speak in the name of ana: there is no answer before that to the next command.
    count = len(client.all(answers))
    setting.publish(f"{base}/set/ana/knu/Robot/gain", "5")
    setting.publish(f"{base}/set/ben", json.dumps({"id": "last", "values": {"gain": 6}}))
    client.becomes(base + "/answer/ben", lambda one: one["id"] == "last", "the last refusal")
    assert len(client.all(answers)) == count
    assert server.get(f"{API}/boards/{setting.node}/variables/gain", Authorization=f"Bearer {TOKEN}").json()["value"] == 3.5
    audit = server.get(API + "/audit", Authorization=f"Bearer {TOKEN}").json()["audit"]
    done = [(one["who"], one["what"], one["reason"]) for one in audit if one["outcome"] == "done"]
    assert done == [("ana", "gain=2.5 mode=AUTO", "shift"), ("ana", "knu::Robot::gain=3.5", "MQTT")], done
    assert any(one["who"] == "ben" and one["outcome"] not in ("begun", "done") for one in audit), audit


def test_retained_commands_are_not_executed(setting):
    server, client = start_with_users(setting)
    base = f"indurop/{setting.node}"
    setting.end(setting.door)
    setting.publish(f"{base}/set/ana/knu/Robot/gain", "9", "-r")
    start_door_with_users(setting, server)
    refused = client.becomes(base + "/answer/ana", lambda one: not one["done"], "the refusal")
    assert "retained" in refused["message"], refused
    assert server.get(f"{API}/boards/{setting.node}/variables/gain", Authorization=f"Bearer {TOKEN}").json()["value"] == 1


def test_broker_and_server_come_back(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    door = setting.start_door(server)  # before the broker
    setting.log_has("cannot be reached")
    setting.start_broker()
    client = setting.subscribe("indurop/#")
    gain = f"indurop/{setting.node}/values/knu/Robot/gain"
    client.becomes(gain, lambda one: one["value"] == 1, "a value")
    setting.end(setting.broker, signal.SIGKILL)
    assert server.post(f"{API}/boards/{setting.node}/set", {"values": {"gain": 7}}).status == 200
    setting.start_broker()
    client = setting.subscribe("indurop/#")
    client.becomes(gain, lambda one: one["value"] == 7, "the value of meanwhile")
    alive = f"indurop/{setting.node}/alive"
    setting.end(server.child, signal.SIGKILL)
    client.becomes(alive, lambda one: one is False, "the server to be missed")
    again = setting.start(setting.programs / "indurop-serve", "--node", setting.node, "--port", server.port)
    client.becomes(alive, lambda one: one is True, "the server to be back")
    setting.end(again)
    setting.end(door, signal.SIGKILL)
    client.becomes("indurop/online", lambda one: one is False, "the will")
    door = setting.start_door(server)
    client.becomes("indurop/online", lambda one: one is True, "the door to be back")
    assert setting.end(door) == 143
    client.becomes("indurop/online", lambda one: one is False, "its end")


def test_tls(setting):
    setting.start_node()
    server = setting.start_server()
    setting.make_authority("ca")
    setting.make_authority("other")
    setting.make_certificate("broker", "ca", "DNS:localhost")
    setting.broker_lines += [f"cafile {setting.folder}/ca.pem", f"certfile {setting.folder}/broker.pem", f"keyfile {setting.folder}/broker.key"]
    setting.start_broker()
    wrong = setting.start_door(server, "--broker-ca", setting.folder / "other.pem", scheme="mqtts", host="localhost")
    setting.log_has("warning: plain topics: ")
    setting.end(wrong)
    setting.start_door(server, "--broker-ca", setting.folder / "ca.pem", scheme="mqtts", host="localhost")
    setting.log_has("plain topics are published")
    setting.client = ["-h", "localhost", "--cafile", str(setting.folder / "ca.pem")]
    client = setting.subscribe("indurop/#")
    client.becomes(f"indurop/{setting.node}/values/knu/Robot/gain", lambda one: one["value"] == 1, "a value")
    # A certificate is for its host only.
    setting.log.write_text("")
    setting.start_door(server, "--broker-ca", setting.folder / "ca.pem", "--client-id", "third", scheme="mqtts")
    setting.log_has("warning: plain topics: ")
    assert "plain topics are published" not in setting.log.read_text()


def test_a_broker_that_asks_for_a_certificate(setting):
    setting.start_node()
    server = setting.start_server()
    setting.make_authority("ca")
    setting.make_certificate("broker", "ca", "IP:127.0.0.1")
    setting.make_certificate("door", "ca", "DNS:door")
    setting.broker_lines += [f"cafile {setting.folder}/ca.pem", f"certfile {setting.folder}/broker.pem", f"keyfile {setting.folder}/broker.key",
                             "require_certificate true"]
    setting.start_broker()
    ca = ["--broker-ca", setting.folder / "ca.pem"]
    without = setting.start_door(server, *ca, scheme="mqtts")
    setting.log_has("warning: plain topics: ")
    assert "plain topics are published" not in setting.log.read_text()
    setting.end(without)
    setting.start_door(server, *ca, "--broker-cert", setting.folder / "door.pem", "--broker-key", setting.folder / "door.key", scheme="mqtts")
    setting.log_has("plain topics are published")


def test_a_server_with_tls_and_tokens(setting):
    setting.start_node()
    setting.make_authority("ca")
    setting.make_certificate("server", "ca", "DNS:localhost")
    setting.tokens.write_text(f"reader {TOKEN} look\nben {BEN} operate\n")
    server = setting.start_server("--write", "--bind", "0.0.0.0", "--cert", setting.folder / "server.pem", "--key", setting.folder / "server.key",
                                  "--token-file", setting.tokens)
    setting.start_broker()
    base = f"indurop/{setting.node}"
    client = setting.subscribe("indurop/#")
    wrong = setting.folder / "wrong"
    wrong.write_text(f"reader {TOKEN[1:]}x\n")
    wrong.chmod(0o600)
    ca = ["--serve-ca", setting.folder / "ca.pem"]
    for options, host, why in (((*ca, "--token-file", wrong), "https://localhost", "does not offer its stream"),
                               ((*ca, "--token-file", setting.tokens), "https://127.0.0.1", "cannot be reached: "),
                               (("--token-file", setting.tokens), "https://localhost", "cannot be reached: ")):
        refused = setting.start_door(server, *options, serve=host)
        setting.log_has(why)
        setting.end(refused)
        assert "the boards of" not in setting.log.read_text(), setting.log.read_text()
        setting.log.write_text("")
    setting.start_door(server, *ca, "--token-file", setting.tokens, serve="https://localhost")
    client.becomes(base + "/values/knu/Robot/gain", lambda one: one["value"] == 1, "a value")
    setting.publish(f"{base}/set/ben/knu/Robot/gain", "2")
    client.becomes(base + "/values/knu/Robot/gain", lambda one: one["value"] == 2, "the value")


def test_is_not_open_by_mistake(setting):
    (setting.folder / "open").write_text(f"a {TOKEN}\n")
    (setting.folder / "open").chmod(0o644)
    for options, text in ((["--broker", "mqtt://broker.example"], "unencrypted"), (["--broker", "http://x"], "--broker"),
                          (["--no-plain"], "nothing would be published"), (["--sparkplug", "a/b"], "level"),
                          (["--deadband", "x"], "--deadband"), (["--commander", "x"], "--token-file"),
                          (["--token-file", setting.folder / "open"], "chmod 600")):
        done = subprocess.run([setting.programs / "indurop-mqtt", *options], capture_output=True, text=True, timeout=60, check=False)
        assert done.returncode == 2 and "error:" in done.stderr and text in done.stderr, (options, done)


if __name__ == "__main__":
    main(globals())
