#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""History over OPC UA, read by node-opcua's client: value by value what `indurop recording export` has of the same time, in any
pages, forward and backward. history_test.py PROGRAMS FAKE_NODE [TEST...]"""

import csv
import random
import subprocess
import time

from opcua_harness import API, main, wait_for

SECOND = 10**9
SAME_CLOCK_NS = 10_000_000
TICK_NS = 100  # of a date in OPC UA


def begin(setting, *options):
    folder = setting.folder / "recordings"
    folder.mkdir()
    node = setting.start_real_node("--record", folder / "run.mcap", *options)
    server = setting.start_server("--recordings", folder)
    return node, server, setting.client(setting.start_opcua(server, "--anonymous"))


def read(client, node, start, end, most=0, **words):
    """All values and the last status; `most`: of each answer."""
    values, point = [], None
    while True:
        count = most() if callable(most) else most
        answer = client.do("history", node=node, start=start and str(start), end=end and str(end), most=count, point=point, **words)
        assert count == 0 or len(answer["values"]) <= count, answer
        values += answer["values"]
        if answer["point"] is None:
            return values, answer["code"]
        assert answer["code"] == "Good", answer
        point = answer["point"]


def difference(found, expected):
    """How many there are, and the first ones that differ."""
    at = next((i for i, both in enumerate(zip(found, expected)) if both[0] != both[1]), min(len(found), len(expected)))
    return len(found), len(expected), at, found[at:at + 2], expected[at:at + 2]


def is_known(server, setting, until):
    page = server.get(f"{API}/boards/{setting.node}/history?name=every::count&from_ns={until - 1}").json()
    return page["end_ns"] > until


def test_equals_a_recording_and_any_part_of_it(setting):
    start = time.time_ns() // TICK_NS * TICK_NS
    node, server, client = begin(setting)
    wait_for(lambda: setting.get_count() > 1500, "values")
    count, y = setting.id("every::count"), setting.id("every::points[1].y")
    lost, first = client.do("history", node=count, start=str(start), most=2)["values"]
    assert lost["code"] == "BadDataLost" and int(lost["ns"]) == start, "before the node began nothing is known"
    begun = (int(first["ns"]) // TICK_NS + 1) * TICK_NS
    now = begun + SECOND
    wait_for(lambda: is_known(server, setting, now), "the server to know it")
    whole, code = read(client, count, begun, now)
    parts, _ = read(client, y, begun, now)
    assert code == "Good" and len(whole) > 500
    chance = random.Random(11)
    times = [int(one["ns"]) for one in whole]
    assert times == sorted(times), [(i, times[i:i + 2]) for i in range(len(times) - 1) if times[i] > times[i + 1]][:5]
    assert all(one["code"] == "Good" for one in whole), [one for one in whole if one["code"] != "Good"][:5]
    for _ in range(12):
        a, b = sorted(chance.randrange(times[0], now) // TICK_NS * TICK_NS for _ in range(2))
        most = chance.choice([1, 3, 50, 0, lambda: chance.randrange(1, 100)])
        b = min(b, a + 20_000_000 if most in (1, 3) else b)
        expected = [one for one in whole if a <= int(one["ns"]) < b]
        found, code = read(client, count, a, b, most)
        assert found == expected and code == ("Good" if expected else "GoodNoData"), (a, b, code, difference(found, expected))
        back, _ = read(client, count, b, a, most)
        assert back == expected[::-1], (a, b, difference(back, expected[::-1]))
    setting.end(node)
    for found, name in ((whole, "every::count"), (parts, "every::points[1].y")):
        recorded = exported(setting, name.partition("[")[0], name)
        shift = next(int(found[-1]["ns"]) - when for when, text in recorded if int(text) == value_of(found[-1]))
        assert abs(shift) < SAME_CLOCK_NS, shift
        expected = [(when + shift, int(text)) for when, text in recorded if begun <= when + shift < now]
        mine = [(int(one["ns"]), value_of(one)) for one in found]
        assert mine == expected, (name, len(mine), len(expected), mine[:2], expected[:2])


def value_of(one):
    """A UInt64 comes as its two halves."""
    value = one["value"]
    return value[0] * 2**32 + value[1] if isinstance(value, list) else int(value)


def exported(setting, variable, name):
    """(time, value) of each change of a number of a variable."""
    sheet = setting.folder / "sheet.csv"
    subprocess.run([setting.programs / "indurop", "recording", "export", setting.folder / "recordings" / "run.mcap", variable, "--csv", sheet],
                   check=True, capture_output=True, env=setting.environment)
    with sheet.open() as lines:
        rows = [(int(row["time_ns"]), row[name]) for row in csv.DictReader(lines)]
    sheet.unlink()
    return [row for i, row in enumerate(rows) if i == 0 or rows[i - 1][1] != row[1]]


def test_bounds_and_what_is_not_known(setting):
    _, server, client = begin(setting)
    wait_for(lambda: setting.get_count() > 500, "values")
    now = time.time_ns() // TICK_NS * TICK_NS
    wait_for(lambda: is_known(server, setting, now), "the server to know it")
    count = setting.id("every::count")
    whole, _ = read(client, count, now - 300_000_000, now)
    a, b = int(whole[10]["ns"]) + 200, int(whole[20]["ns"]) + 200
    found, _ = read(client, count, a, b, bounds=True)
    assert found == whole[10:22], (found[:2], whole[10:12])
    for most in (1, 2, 5):
        assert read(client, count, a, b, most, bounds=True)[0] == found
    assert read(client, count, int(whole[10]["ns"]), b, bounds=True)[0][0] == whole[10], "a value at the begin is its own bound"
    future = now + 3600 * SECOND
    found, code = read(client, count, future, future + SECOND)
    assert found == [] and code == "GoodNoData"
    found, _ = read(client, count, future, future + SECOND, bounds=True)
    assert [one["code"] for one in found][-1] == "BadBoundNotFound", found
    assert read(client, count, now - 7200 * SECOND, now - 3600 * SECOND) == ([], "GoodNoData")
    newest = client.do("history", node=count, end=str(now), most=7)["values"]
    assert newest == whole[:-8:-1], (newest[:2], whole[-2:])
    oldest = client.do("history", node=count, start=str(int(whole[3]["ns"])), most=4)["values"]
    assert oldest == whole[3:7], oldest
    assert client.read(count, attribute="Historizing")["value"] is True
    assert client.read(count, attribute="AccessLevel")["value"] & 4 and client.read(count, attribute="UserAccessLevel")["value"] & 4
    matrix = setting.id("every::matrix")
    (one,) = [one for one in read(client, matrix, now - 600 * SECOND, now)[0] if one["code"] == "Good" and one["value"][5] == 12.5]
    assert one["dims"] == [2, 3]
    numbers, _ = read(client, setting.id("every::numbers"), now - 600 * SECOND, now, range="2:3")
    assert [one["value"] for one in numbers if one["code"] == "Good"][-1] == [0, -7], numbers
    point = [one for one in read(client, setting.id("every::point"), now - 600 * SECOND, now)[0] if one["code"] == "Good"][-1]
    assert point["value"]["x"] == 1.5 and point["value"]["mode"] == 2, point


def test_what_cannot_be_read_is_refused(setting):
    _, _, client = begin(setting)
    count, flag = setting.id("every::count"), setting.id("every::flag")
    code = lambda **words: client.do("history", **{"node": count, **words})["code"]
    now = str(time.time_ns())
    assert code(start=now) == code(end=now) == code(most=5) == code() == "BadHistoryOperationInvalid"
    assert code(start=now, end=now, modified=True) == "BadHistoryOperationUnsupported"
    assert code(start=now, details="atTime") == "BadHistoryOperationUnsupported"
    assert code(start=now, end=str(int(now) - SECOND), bounds=True) == "BadHistoryOperationUnsupported"
    assert code(node=setting.id("every::missing"), start=now, most=1) == "BadNodeIdUnknown"
    early = str(int(now) - SECOND)
    answer = client.do("history", node=count, start=early, end=now, most=2)
    good = answer["point"]
    assert good
    chance = random.Random(5)
    raw = bytes.fromhex(good)
    for point in (b"x", b"{}", b"[]", b"null", b'{"node":1}', raw[:-1], raw.replace(b"count", b"flagg"), b"\xff" * 50):
        assert code(start=early, end=now, most=2, point=point.hex()) == "BadContinuationPointInvalid", point
    for _ in range(40):
        torn = bytearray(raw)
        for _ in range(chance.randrange(1, 4)):
            torn[chance.randrange(len(torn))] = chance.randrange(256)
        assert code(start=early, end=now, most=2, point=bytes(torn).hex()) in ("BadContinuationPointInvalid", "Good", "GoodNoData"), bytes(torn)
    assert code(node=flag, start=early, end=now, most=2, point=good) == "BadContinuationPointInvalid", "that of another node"
    assert code(start=early, end=now, most=2, point=good, release=True) == "Good"
    assert setting.opcua.poll() is None


def test_boards_go_and_the_server_is_lost(setting):
    node, server, client = begin(setting)
    count = setting.id("every::count")
    wait_for(lambda: setting.get_count() > 100, "values")
    setting.end(node)
    past = str(time.time_ns() - 3600 * SECOND)
    values, code = read(client, count, past, time.time_ns())
    assert code == "Good" and len([one for one in values if one["code"] == "Good"]) > 100, "what was recorded can still be read"
    assert values[-1]["code"] == "BadDataLost", "the node does not run any more"
    setting.end(server.child)
    assert client.do("history", node=count, start=past, most=5)["code"] == "BadNoCommunication"


if __name__ == "__main__":
    main(globals())
