#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop-serve before a board of another host: a board whose memory it cannot see, heard through its agent only. The board's
values, as they arrive here, are compared with those that a server on its host reads from its memory. remote_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import harness
from harness import TOKEN, wait_for
from plant_test import API, start_agent, take_domain
from websocket import WebSocket

# Of its own: memory (/dev/shm) and the mounts to have it.
ELSEWHERE = ["unshare", "--mount", "--propagation", "private", "sh", "-c", 'mount -t tmpfs none /dev/shm && exec "$0" "$@"']


def there_are_namespaces():
    if shutil.which("unshare") is None:
        return False
    for words in ([], ["--user", "--map-root-user"]):
        tried = subprocess.run(["unshare", *words, *ELSEWHERE[1:], "true"], stderr=subprocess.DEVNULL, check=False)
        if tried.returncode == 0:
            ELSEWHERE[1:1] = words
            return True
    return False


def start_remote_server(setting, domain, *options):
    """A server on another host than the nodes of this one."""
    child = setting.start(*ELSEWHERE, setting.programs / "indurop-serve", "--port", 0, "--plant", "--domain", domain, "--one-host",
                          "--write", "--token-file", setting.tokens, *options)
    found = re.match(r"https?://[^/]*:(\d+)/", child.stdout.readline())
    assert found
    return harness.Server(int(found.group(1)), child)


def board_of(setting):
    return f"{API}/boards/{setting.node}"


def begin(setting, *options):
    """A board with its agent, a server on its host, and one on another host that receives the board."""
    domain = take_domain(setting)
    setting.start_node(*options)
    agent = start_agent(setting, setting.node, domain)
    near = setting.start_server()
    remote = start_remote_server(setting, domain)
    wait_for(lambda: [one["board"] for one in remote.get(API + "/boards").json()["boards"]] == [setting.node], "the board to be heard")
    return domain, agent, near, remote


def variables(server, setting):
    answer = server.get(board_of(setting) + "/variables")
    return {one["name"]: one for one in answer.json()["variables"]} if answer.status == 200 else {}


def test_shows_the_variables_of_a_board_elsewhere(setting):
    _, _, near, remote = begin(setting)
    assert remote.get(API + "/boards").json()["boards"][0]["here"] is False
    wait_for(lambda: variables(remote, setting), "variables")
    there, here = variables(near, setting), variables(remote, setting)
    assert there.keys() == here.keys() and len(here) > 3, here.keys()
    for name, one in here.items():
        for what in ("type", "form", "unit", "range", "description", "retain"):
            assert one[what] == there[name][what], (name, what)
        assert one["age_ns"] is not None and one["age_ns"] >= 0, one
    steady = [name for name in here if there[name]["value"] == variables(near, setting)[name]["value"]]
    assert steady and all(here[name]["value"] == there[name]["value"] for name in steady), steady
    one = remote.get(board_of(setting) + "/variables/gain").json()
    assert one["value"] == there["knu::Robot::gain"]["value"] and one["quality"] == "good", one
    missing = remote.get(board_of(setting) + "/variables/gian")
    assert missing.status == 404 and "did you mean" in missing.json()["message"], missing.body


def test_follows_values_and_says_when_they_are_old(setting):
    domain, agent, _, remote = begin(setting)
    wait_for(lambda: variables(remote, setting), "variables")
    client = WebSocket(remote.port)
    client.say(type="subscribe", id=1, board=setting.node, names=["tick", "gain"], rate_hz=10)
    answer = client.heard("subscribed")
    assert [one["name"] for one in answer["variables"]] == ["knu::Robot::tick", "knu::Robot::gain"], answer
    ticks = set()
    while len(ticks) < 4:
        frame = client.heard("values")
        assert frame["alive"] and not frame["quality"], frame
        ticks.add(frame["values"].get("knu::Robot::tick"))
    setting.end(agent, signal.SIGKILL)
    while client.heard("values")["quality"].get("knu::Robot::gain") != "silent":
        pass
    summary = wait_for(lambda: [one for one in remote.get(API + "/boards").json()["boards"] if not one["alive"]], "the board to be missed")
    assert summary[0]["state"].startswith("not heard, last ") and summary[0]["trouble"], summary
    last = variables(remote, setting)["knu::Robot::gain"]
    assert last["quality"] == "silent" and last["value"] is not None, last
    start_agent(setting, setting.node, domain)
    while client.heard("values")["quality"]:
        pass
    client.close()


def deploy(setting, domain, *modules, board=None):
    """These of tests/modules, every 10 ms, by the board's agent; a module that is there already is replaced."""
    board = board or setting.node
    for name in modules:
        shutil.copy(pathlib.Path(setting.fake_node).parent / "modules" / f"{name}.so", setting.folder)
    (setting.folder / "plant.xml").write_text(
        f"""<plant name="{board}"><domain>{domain % 200 + 1}</domain><external>off</external><board name="{board}">""" + "".join(
            f"""<module><filename>./{name}.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
<period>10ms</period><priority>{i + 1}</priority></module>""" for i, name in enumerate(modules)) + "</board></plant>\n")
    done = subprocess.run([setting.programs / "indurop", "deploy", "plant.xml", "--health", "300ms", "--domain", str(domain), "--one-host"],
                          cwd=setting.folder, env=setting.environment, capture_output=True, text=True, timeout=harness.DEADLINE_S, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def begin_deployed(setting):
    domain = take_domain(setting)
    agent = start_agent(setting, setting.node, domain)
    remote = start_remote_server(setting, domain)
    deploy(setting, domain, "counter", "faulty")
    wait_for(lambda: variables(remote, setting), "variables of what was deployed")
    return domain, agent, setting.start_server(), remote


def end_deployed(setting, agent):
    setting.end(agent)  # and with it the node


def test_sets_forces_and_releases_and_logs_it(setting):
    _, agent, near, remote = begin_deployed(setting)
    base = board_of(setting)
    looks = lambda server: variables(server, setting)["nt::looks"]
    refused = remote.post(base + "/set", {"values": {"looks": 3}}, token=None)
    assert refused.status in (401, 403), refused.status
    done = remote.post(base + "/set", {"values": {"looks": 3}, "reason": "because"})
    assert done.status == 200 and done.json()["written"] == ["looks"], done.body
    assert looks(near)["value"] == 3 and looks(remote)["value"] == 3
    for values in ({"looks": "many"}, {"look": 1}, {"looks": "1\nlooks=2"}, {"looks=1\nx": 1}, {"looks": 4, "look": 1}):
        answer = remote.post(base + "/set", {"values": values})
        assert answer.status == 422 and answer.json()["message"], answer.body
        assert looks(near)["value"] == 3, "all or nothing"
    assert remote.post(base + "/force", {"values": {"looks": 5}, "reason": "stuck"}).status == 200
    forced = wait_for(lambda: remote.get(base + "/forces").json()["forces"], "the force to be seen")
    assert (forced[0]["name"], forced[0]["value"], forced[0]["reason"]) == ("nt::looks", 5, "stuck") and "ana" in forced[0]["who"], forced
    assert looks(remote)["forced"] == ["nt::looks"] == looks(near)["forced"] and looks(remote)["value"] == 5
    assert remote.post(base + "/release", {"names": ["looks"]}).status == 200
    assert not looks(remote)["forced"] and not looks(near)["forced"]
    assert remote.post(base + "/lock", {"lock": "all", "reason": "night"}).status == 200
    locked = remote.post(base + "/set", {"values": {"looks": 1}})
    assert locked.status == 422 and "lock" in locked.json()["message"] and looks(near)["value"] == 5, locked.body
    assert looks(remote) and remote.get(base + "/forces").json()["lock"]["lock"] == "all"
    assert remote.post(base + "/lock", {"lock": "none"}).status == 200
    assert remote.post(base + "/set", {"values": {"looks": "INT#16#11"}}).status == 200 and looks(near)["value"] == 17
    assert remote.post(base + "/modules/counter/stop?reason=belt%20torn").status == 200
    orders = (setting.folder / "state" / setting.node / "orders.jsonl").read_text().splitlines()
    stop = [one for one in map(json.loads, orders) if one["action"] == "stop"]
    assert [(one["what"], one["reason"]) for one in stop] == [("counter", "belt torn")] and "ana" in stop[0]["who"], stop
    assert near.get(base + "/modules").json()["modules"][0]["state"] == "stopped"
    assert remote.post(base + "/modules/missing/stop").status == 422
    notes = remote.get(API + "/audit", Authorization="Bearer " + harness.TOKEN).json()["audit"]
    done = sorted(one["action"] for one in notes if one["outcome"] == "done" and one["who"] == "ana")
    assert done == ["force", "lock", "lock", "release", "set", "set", "stop"], notes
    assert len([one for one in notes if one["outcome"] not in ("begun", "done")]) >= 7, "what was refused is noted, too"
    end_deployed(setting, agent)


def renewed_beyond(server, base, lease, still):
    """Renews a lease for longer than it holds without that; `still` holds all the time."""
    end = time.monotonic() + 1.5 * lease["lease_ns"] / 1e9
    while time.monotonic() < end:
        answer = server.post(f"{base}/leases/{lease['lease']}/renew")
        assert answer.status == 200, answer.body
        assert still(), "it is renewed"
        time.sleep(lease["lease_ns"] / 20e9)


def test_a_lease_ends_with_its_client(setting):
    domain, agent, near, remote = begin_deployed(setting)
    setting.tokens.write_text(f"ana {TOKEN}\nbob {TOKEN[::-1]}\n")
    setting.end(remote.child)
    remote = start_remote_server(setting, domain)
    wait_for(lambda: variables(remote, setting), "variables")
    base = board_of(setting)
    forces = lambda: near.get(base + "/forces").json()["forces"]
    take = lambda: remote.post(base + "/force", {"values": {"looks": 3}, "lease": True, "reason": "stuck"}).json()
    wrong = remote.post(base + "/force", {"values": {"look": 3}, "lease": True})
    assert wrong.status == 422, wrong.body
    lease = take()
    assert lease["forced"] == ["looks"], lease
    renew = f"{base}/leases/{lease['lease']}/renew"
    assert (forces()[0]["lease"], forces()[0]["reason"]) == (True, "stuck"), forces()
    wait_for(lambda: remote.get(base + "/forces").json()["forces"], "the force to be seen")
    renewed_beyond(remote, base, lease, forces)
    assert remote.post(renew, token=TOKEN[::-1]).status == 404, "of another user"
    assert remote.post(base + "/leases/nothing/renew").status == 404
    wait_for(lambda: not forces(), "the end of a lease that its client does not renew")
    assert remote.post(renew).status == 404
    audit = lambda words: [one for one in remote.get(API + "/audit", Authorization="Bearer " + TOKEN).json()["audit"] if words in one["outcome"]]
    ended = wait_for(lambda: audit("did not renew it in time"), "a note about it")
    assert (ended[0]["who"], ended[0]["what"]) == ("ana", "looks=3"), ended
    lease = take()
    assert remote.post(f"{base}/leases/{lease['lease']}/end").status == 200
    wait_for(lambda: not forces(), "the end of a lease that its client has ended")
    lease = take()
    done = subprocess.run([setting.programs / "indurop", "unforce", "looks", "--node", setting.node], env=setting.environment, check=False)
    assert done.returncode == 0 and not forces()
    wait_for(lambda: remote.post(f"{base}/leases/{lease['lease']}/renew").status == 404, "the loss of what another user has released")
    assert audit("lost: "), "it is noted"
    many = []
    for i in range(32):
        many.append(remote.post(base + "/force", {"values": {f"block.word[{i}]": 1}, "lease": True}).json()["lease"])
        assert all(remote.post(f"{base}/leases/{one}/renew").status == 200 for one in many), i
    full = remote.post(base + "/force", {"values": {"looks": 3}, "lease": True})
    assert full.status == 422 and "32 forces with a lease" in full.json()["message"], full.body
    setting.end(remote.child, signal.SIGKILL)
    wait_for(lambda: not forces(), "the end of leases whose server was killed")
    end_deployed(setting, agent)


def test_a_board_that_does_not_answer_costs_no_lease_of_another_one(setting):
    domain, agent, near, remote = begin_deployed(setting)
    other = setting.node + "_other"
    hung = start_agent(setting, other, domain)
    deploy(setting, domain, "faulty", board=other)
    base, of_other = board_of(setting), f"{API}/boards/{other}"
    force = {"values": {"looks": 3}, "lease": True}
    lost = wait_for(lambda: (answer := remote.post(of_other + "/force", force)).status == 200 and answer, "a lease of the other board").json()
    lease = remote.post(base + "/force", force).json()
    hung.send_signal(signal.SIGSTOP)
    renewed_beyond(remote, base, lease, lambda: near.get(base + "/forces").json()["forces"])
    wait_for(lambda: remote.post(f"{of_other}/leases/{lost['lease']}/renew").status == 404, "the loss of what its board does not answer for")
    hung.send_signal(signal.SIGCONT)
    setting.end(hung)
    end_deployed(setting, agent)


def test_says_what_was_printed_and_what_is_not_seen_from_here(setting):
    _, agent, near, remote = begin_deployed(setting)
    base = board_of(setting)
    there, here = near.get(base + "/messages").json(), remote.get(base + "/messages").json()
    assert here["messages"] and here["messages"] == there["messages"], (here, there)
    assert any(one["who"] == "counter" and "starts with" in one["text"] for one in here["messages"]), here
    assert remote.get(base + "/messages?count=1").json()["messages"] == here["messages"][-1:]
    for path in ("/recipes", "/scope?channel=looks"):
        answer = remote.get(base + path)
        assert answer.status == 409 and "on another host" in answer.json()["message"], answer.body
    end_deployed(setting, agent)


STEADY = ("name", "type", "operation", "period_ns", "priority", "core", "offset_ns", "deadline_ns", "budget_ns", "file", "state")


def test_shows_modules_with_their_times_and_the_schedule(setting):
    domain, agent, near, remote = begin_deployed(setting)
    base = board_of(setting)
    ask = lambda server, path: server.get(base + path).json()
    there, here = (ask(server, "/modules")["modules"] for server in (near, remote))
    assert [[one[what] for what in STEADY] for one in here] == [[one[what] for what in STEADY] for one in there], (here, there)
    wait_for(lambda: remote.get(base + "/modules").json()["alive"] is True, "the first sign of life")
    plan = ask(remote, "/schedule")
    assert plan["plan"] is None and "board's host" in plan["message"], plan
    assert {what: plan[what] for what in ("basic_period_ns", "macro_period_ns", "slots", "epoch_ns")} == {
        what: ask(near, "/schedule")[what] for what in ("basic_period_ns", "macro_period_ns", "slots", "epoch_ns")}
    seen = wait_for(lambda: ask(remote, "/runs?count=50")["runs"], "runs")
    local = {one["number"]: one for one in ask(near, "/runs?count=8192")["runs"]}
    assert all(local[one["number"]] == one for one in seen), "runs are those of the board's memory"
    last = seen[-1]["number"]
    newer = wait_for(lambda: ask(remote, f"/runs?after={last}")["runs"], "newer runs")
    assert newer[0]["number"] > last
    exec_of = lambda server: ask(server, "/modules/counter/histograms")["histograms"]["exec"]
    few, many = exec_of(remote), exec_of(near)
    assert 0 < few["count"] <= many["count"] and few["min_ns"] >= many["min_ns"] and few["max_ns"] <= many["max_ns"], (few, many)
    assert ask(remote, "/overruns")["overruns"] == ask(near, "/overruns")["overruns"]
    assert remote.get(base + "/modules/missing/histograms").status == 404
    setting.end(agent, signal.SIGKILL)
    assert wait_for(lambda: remote.get(base + "/modules").status == 504, "the answer that the board does not answer")
    agent = start_agent(setting, setting.node, domain)
    wait_for(lambda: remote.get(base + "/modules").status == 200, "the board again")
    end_deployed(setting, agent)


def test_alarms_are_evaluated_by_the_agent_and_acknowledged_from_another_host(setting):
    domain = take_domain(setting)
    agent = start_agent(setting, setting.node, domain)
    remote = start_remote_server(setting, domain)
    deploy(setting, domain, "counter")
    wait_for(lambda: variables(remote, setting), "variables of what was deployed")
    base = board_of(setting)
    ask = lambda server, path="": server.get(f"{base}/alarms{path}").json()
    of = lambda server: [(one["alarm"], one["state"]) for one in ask(server)["alarms"]]
    alarm = "nt::torn > 1000"
    assert [one["alarm"] for one in ask(remote, "?all=true")["alarms"]] == [alarm] and of(remote) == [], ask(remote)
    assert remote.post(base + "/set", {"values": {"torn": 1001}}).status == 200
    wait_for(lambda: of(remote) == [(alarm, "unacknowledged")], "the alarm, which only the agent can have evaluated")
    assert ask(remote)["watched"] is True
    summary = wait_for(lambda: [one for one in remote.get(API + "/boards").json()["boards"] if one["alarms"]["unacknowledged"] == 1], "its count")
    assert summary[0]["alarms"]["worst"] == "high" and any("alarm" in text for text in summary[0]["trouble"]), summary
    near = setting.start_server()
    assert of(near) == of(remote) and ask(near)["counts"] == ask(remote)["counts"]
    order = lambda what, body, **more: remote.post(f"{base}/alarms/{what}", body, **more)
    assert order("ack", {"all": True}, token=None).status in (401, 403)
    said = order("ack", {"alarms": ["tron"]})
    assert said.status == 422 and "no alarm" in said.json()["message"], said.body
    said = order("ack", {"alarms": ["torn\nx"]})
    assert said.status == 422, said.body
    assert order("shelve", {"alarms": ["torn"]}).status == 400, "for how long?"
    assert of(near) == [(alarm, "unacknowledged")], "nothing was done"
    done = order("ack", {"alarms": ["torn"], "reason": "seen"})
    assert done.status == 200 and done.json()["alarms"] == [alarm], done.body
    alarm_now = ask(near)["alarms"][0]
    assert alarm_now["state"] == "acknowledged" and alarm_now["reason"] == "seen" and "ana" in alarm_now["who"], alarm_now
    assert order("ack", {"all": True}).json()["alarms"] == [], "there was nothing to do"
    assert order("shelve", {"all": True, "for_ns": 3600 * 10**9}).status == 200
    assert of(near) == of(remote) == [(alarm, "shelved")]
    assert order("unshelve", {"alarms": [alarm]}).json()["alarms"] == [alarm]
    wait_for(lambda: of(remote) == [(alarm, "unacknowledged")], "it is raised again")
    events = lambda server: [(one["event"], one["alarm"]) for one in ask(server, "/history?count=5")["events"]]
    assert events(remote) == events(near) and [one[0] for one in events(remote)[:4]] == ["raised", "acknowledged", "shelved", "unshelved"], events(remote)
    notes = remote.get(API + "/audit", Authorization="Bearer " + harness.TOKEN).json()["audit"]
    assert {"acknowledge", "shelve", "unshelve"} <= {one["action"] for one in notes if one["outcome"] == "done"}, notes
    end_deployed(setting, agent)


def test_a_deployment_of_others_ends_what_was_followed(setting):
    domain, agent, _, remote = begin_deployed(setting)
    client = WebSocket(remote.port)
    client.say(type="subscribe", id=7, board=setting.node, names=["nt::*"], rate_hz=10)
    client.heard("subscribed")
    deploy(setting, domain, "layout_old")
    assert client.heard("layout_changed")["ids"] == [7]
    old = variables(remote, setting)["nt_layout::axis"]
    client.say(type="subscribe", id=8, board=setting.node, names=["nt_layout::*"], rate_hz=10)
    client.heard("subscribed")
    deploy(setting, domain, "layout_new")
    assert client.heard("layout_changed")["ids"] == [8]
    new = variables(remote, setting)["nt_layout::axis"]
    assert new["form"] != old["form"], new
    client.close()
    end_deployed(setting, agent)


if __name__ == "__main__":
    if not there_are_namespaces():
        print("skipped: no namespaces for memory of its own here")
        sys.exit(77)
    os.environ.pop("INDUROP_NODE", None)
    harness.main(globals())
