#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The history of variables over HTTP: a recording of the same time, exported by `indurop recording export`, says value by value
what has to be in it, in whatever pages it is read. history_test.py PROGRAMS FAKE_NODE [TEST...]"""

import csv
import os
import pathlib
import random
import shutil
import subprocess
import time
import urllib.parse

import harness
from harness import wait_for

API = "/api/v1"
SECOND = 10**9
MODULE = """<root><module><filename>{file}</filename><moduletype>thread</moduletype>
<operationtype>periodic</operationtype><period>1ms</period><priority>1</priority></module></root>
"""
SAME_CLOCK_NS = 10_000_000
NAMES = ["past::count", "past::slow", "past::wave", "past::both.a", "past::pairs[1].a", "past::text", "past::parameter"]


def start(setting, *options, record=False):
    """A node with the module of history.cpp; with `record` it is recorded into the folder of recordings."""
    folder = setting.folder / "recordings"
    folder.mkdir(exist_ok=True)
    module = pathlib.Path(os.environ["HISTORY_MODULE"])
    shutil.copy(module, setting.folder)
    (setting.folder / "module.xml").write_text(MODULE.format(file=module.name))
    recorded = ["--record", folder / "run.mcap"] if record else []
    child = setting.start(setting.programs / "indurop", "run", "module.xml", "--node", setting.node, "-q", *recorded, *options,
                          cwd=setting.folder, stderr=subprocess.DEVNULL)
    wait_for(lambda: value_of(setting, "past::count") > 100, "the node to count")
    return child


def indurop(setting, *words):
    return subprocess.run([setting.programs / "indurop", *words], capture_output=True, text=True, check=False, env=setting.environment)


def value_of(setting, name):
    done = indurop(setting, "get", "--node", setting.node, name)
    return int(done.stdout) if done.returncode == 0 else -1


def path_of(setting, names, **words):
    query = [("name", name) for name in names] + list(words.items())
    return f"{API}/boards/{setting.node}/history?{urllib.parse.urlencode(query)}"


def read(server, setting, names, from_ns, to_ns, most=10_000):
    """All pages as one: {name: {"before", "values", "gaps"}}, the end, and how many pages."""
    whole, pages, words = {}, 0, {}
    while True:
        answer = server.get(path_of(setting, names, from_ns=from_ns, to_ns=to_ns, most=most() if callable(most) else most, **words))
        assert answer.status == 200, answer.body
        page = answer.json()
        pages += 1
        for one in page["variables"]:
            known = whole.setdefault(one["name"], {"before": one["before"], "values": [], "gaps": []})
            known["values"] += [(value["time_ns"], value["value"]) for value in one["values"]]
            for gap in one["gaps"]:
                if known["gaps"] and known["gaps"][-1][1] == gap["from_ns"]:
                    known["gaps"][-1] = (known["gaps"][-1][0], gap["to_ns"])
                else:
                    known["gaps"].append((gap["from_ns"], gap["to_ns"]))
        if page["next"] is None:
            return whole, page["end_ns"], pages
        words = {"next": page["next"]}


def exported(setting, file, name):
    """What `indurop recording export` has of a variable: (time, value) of each change."""
    variable = name.split(".")[0].split("[")[0]
    sheet = setting.folder / "sheet.csv"
    sheet.unlink(missing_ok=True)
    done = indurop(setting, "recording", "export", file, variable, "--csv", sheet)
    assert done.returncode == 0, done.stderr
    with sheet.open() as lines:
        rows = [(int(row["time_ns"]), row[name]) for row in csv.DictReader(lines)]
    changes = []
    for when, text in rows:
        if not changes or changes[-1][1] != text:
            changes.append((when, text))
    return changes


def text_of(value):
    return str(int(value)) if isinstance(value, float) and value == int(value) else str(value)


def settled(server, setting, from_ns):
    """The history from a time on up to now, once the server knows it up to now."""
    now = time.time_ns()
    end = 0
    while end < now:
        whole, end, _ = read(server, setting, NAMES, from_ns, now)
    return whole, now


def compare(setting, file, whole, from_ns, to_ns, name):
    """The history against the recording; returns the time of the history minus that of the recording."""
    recorded = exported(setting, file, name)
    values = whole[name]["values"]
    shift = next(mine[0] - other[0] for mine in values for other in recorded if text_of(mine[1]) == other[1]) if values else 0
    assert abs(shift) < SAME_CLOCK_NS, shift
    expected = [(when + shift, text) for when, text in recorded if from_ns <= when + shift < to_ns]
    found = [(when, text_of(value)) for when, value in values]
    found = found[1:] if found[0][1] == "" else found  # an empty text is no row of the sheet
    assert found == expected, (name, len(found), len(expected), [pair for pair in zip(found, expected) if pair[0] != pair[1]][:3])
    return shift


def test_equals_a_recording_of_the_same_time(setting):
    begin = time.time_ns()
    node = start(setting, record=True)
    server = setting.start_server("--recordings", setting.folder / "recordings")
    assert indurop(setting, "set", "--node", setting.node, "past::parameter=7").returncode == 0
    wait_for(lambda: value_of(setting, "past::count") > 1000, "a second of values")
    whole, now = settled(server, setting, begin)
    setting.end(node)
    shifts = {compare(setting, setting.folder / "recordings" / "run.mcap", whole, begin, now, name) for name in NAMES}
    assert len(shifts) == 1, shifts
    counts = [value for _, value in whole["past::count"]["values"]]
    assert counts == list(range(counts[0], counts[0] + len(counts))) and len(counts) > 1000
    assert [value for _, value in whole["past::parameter"]["values"]] == [5, 7]
    for one in whole.values():
        assert one["before"] is None and len(one["gaps"]) == 1 and one["gaps"][0][0] == begin, one["gaps"]


def test_any_window_in_any_pages_is_part_of_the_whole(setting):
    chance = random.Random(7)
    begin = time.time_ns()
    start(setting, "--tape", "1", record=True)
    server = setting.start_server("--recordings", setting.folder / "recordings")
    wait_for(lambda: value_of(setting, "past::count") > 6000, "six seconds of values")
    whole, now = settled(server, setting, begin)
    first = whole["past::count"]["values"][0][0]
    for _ in range(40):
        names = chance.sample(NAMES, chance.randrange(1, len(NAMES) + 1))
        a, b = sorted(chance.randrange(first, now) for _ in range(2))
        most, longest = chance.choice([(1, 10**7), (2, 10**7), (7, 3 * 10**7), (100, SECOND), (10_000, now), (lambda: chance.randrange(1, 300), SECOND)])
        b = min(b, a + chance.choice([1, longest // 3, longest]))
        part, end, _ = read(server, setting, names, a, b, most)
        assert end == b, (end, b)
        for name in names:
            everything = whole[name]["values"]
            expected = [one for one in everything if a <= one[0] < b]
            assert part[name]["values"] == expected, (name, a, b, part[name]["values"][:3], expected[:3])
            before = [one for one in everything if one[0] < a]
            known = part[name]["before"]
            assert (known["time_ns"], known["value"]) == before[-1] if known else not before, (name, known, before[-1:])
            assert part[name]["gaps"] == [], part[name]["gaps"]


def test_says_what_is_not_known(setting):
    begin = time.time_ns()
    node = start(setting, "--tape", "1")
    server = setting.start_server()
    hour = begin - 3600 * SECOND
    whole, _ = settled(server, setting, hour)
    for one in whole.values():
        (gap,) = one["gaps"]
        assert gap[0] == hour and begin < gap[1] <= one["values"][0][0], (gap, one["values"][0])
    # It is killed, and keeps what it did in a black box when it comes back.
    setting.end(node, how=9)
    last = time.time_ns()
    reached = value_of(setting, "past::count")
    back = start(setting)
    wait_for(lambda: value_of(setting, "past::count") > reached + 100, "the node to count again")
    whole, now = settled(server, setting, begin)
    one = whole["past::count"]
    inner = [gap for gap in one["gaps"] if gap[0] > begin]
    assert len(inner) == 1 and inner[0][0] <= last < inner[0][1], (one["gaps"], last)
    lives = [[value for when, value in one["values"] if when < last], [value for when, value in one["values"] if when > last]]
    for counts in lives:
        assert counts == list(range(counts[0], counts[0] + len(counts))), "what is not in a gap is whole"
    assert len(lives[0]) > 50 and lives[1][0] >= lives[0][-1], "variables keep their values over a crash"
    setting.end(back)


def test_follows_a_node(setting):
    start(setting, record=True)
    server = setting.start_server("--recordings", setting.folder / "recordings")
    listed = {one["name"]: one["taped"] for one in server.get(f"{API}/boards/{setting.node}/variables").json()["variables"]}
    assert all(listed[name.split(".")[0].split("[")[0]] for name in NAMES), listed
    page = server.get(path_of(setting, NAMES, follow="true")).json()
    assert all(one["before"] and not one["values"] and not one["gaps"] for one in page["variables"]), page
    begin, whole = page["end_ns"], {name: [] for name in NAMES}
    before = {one["name"]: one["before"]["value"] for one in page["variables"]}
    while page["end_ns"] < begin + 3 * SECOND:
        page = server.get(path_of(setting, NAMES, follow="true", next=page["next"], most=500)).json()
        for one in page["variables"]:
            assert one["gaps"] == [], one["gaps"]
            whole[one["name"]] += [(value["time_ns"], value["value"]) for value in one["values"]]
    expected, _, _ = read(server, setting, NAMES, begin, page["end_ns"])
    for name in NAMES:
        assert whole[name] == expected[name]["values"], name
        assert before[name] == expected[name]["before"]["value"], name
    counts = [value for _, value in whole["past::count"]]
    assert counts == list(range(before["past::count"] + 1, before["past::count"] + 1 + len(counts))) and len(counts) > 2000
    for wrong in ("?name=past::count&follow=1", "?name=past::count&follow=false", "?follow=true"):
        assert server.get(f"{API}/boards/{setting.node}/history{wrong}").status == 400, wrong


def test_has_no_more_than_it_can(setting):
    start(setting)
    server = setting.start_server()
    now = time.time_ns()
    for wrong in ("", "?name=past::count", "?from_ns=1", "?name=past::count&from_ns=x", "?name=past::count&from_ns=-1",
                  "?name=past::count&from_ns=1&to_ns=1e9", "?name=past::count&from_ns=1&most=0", "?name=past::count&from_ns=1&most=10001",
                  "?name=past::count&from_ns=1&values=xml", "?from_ns=1" + "&name=past::count" * 65,
                  f"?name=past::count&from_ns={2**63}"):
        assert server.get(f"{API}/boards/{setting.node}/history{wrong}").status == 400, wrong
    page = server.get(path_of(setting, ["past::count"], from_ns=now - SECOND, most=5)).json()
    good = page["next"]
    chance = random.Random(3)
    for text in ("", "x", "1", "1.2", good + ".0", good.rsplit(".", 1)[0], "-" + good, good + "g", "9" * 400, "." * 70, good.replace(".", ","), "0x1.0.0"):
        assert server.get(path_of(setting, ["past::count"], from_ns=1, next=text)).status == 400, text
    for _ in range(200):
        text = "".join(chance.choice("0123456789abcdef.-") for _ in range(chance.randrange(80)))
        assert server.get(path_of(setting, ["past::count"], from_ns=now - SECOND, next=text)).status in (200, 400), text
    for name in ("past::missing", "past::*", "past::both.c", "past::pairs[2]", "../x", "'"):
        assert server.get(path_of(setting, [name], from_ns=1)).status == 422, name
    assert server.get(f"{API}/boards/missing/history?name=past::count&from_ns=1").status == 404
    assert server.post(f"{API}/boards/{setting.node}/history?name=past::count&from_ns=1").status in (401, 403, 405)
    future = server.get(path_of(setting, ["past::count"], from_ns=2**62, to_ns=2**63 - 1)).json()
    assert future["next"] is None and future["variables"][0]["values"] == []
    # The same variable several times, whole and in part.
    twice = server.get(path_of(setting, ["past::both", "past::both.a", "past::both"], from_ns=now - SECOND, values="bytes")).json()
    whole, part, again = twice["variables"]
    assert whole["values"] == again["values"] and len(whole["values"][0]["bytes"]) == 32 and len(part["values"][0]["bytes"]) == 16
    assert [one["bytes"][:16] for one in whole["values"]] == [one["bytes"] for one in part["values"]]


def test_a_page_is_bounded_and_disturbs_no_stream(setting):
    from websocket import WebSocket
    start(setting)
    server = setting.start_server()
    client = WebSocket(server.port)
    client.say(type="subscribe", id=1, names=["past::count"], rate_hz=50)
    client.heard("subscribed")
    wait_for(lambda: value_of(setting, "past::count") > 1500, "values")
    for _ in range(20):
        page = server.get(path_of(setting, NAMES, from_ns=0, most=500)).json()
        assert sum(len(one["values"]) for one in page["variables"]) <= 500 + len(NAMES) and page["next"]
    before = client.heard("values")["seq"]
    assert client.heard("values")["seq"] > before
    client.close()


if __name__ == "__main__":
    harness.main(globals())
