#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A recording across exchanges with versions that bring variables, or declare one in another way, is cut at random ticks and at
those around the exchanges, and recorded in parts. The pieces, and what they are joined to, have to replay as the whole does, and an
independent reader of the files has to find the same values in them. INDUROP_PARTS_ROUNDS says how many recordings, 2 without it;
INDUROP_PARTS_SEED repeats one."""

import argparse
import bisect
import collections
import csv
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
sys.path.insert(0, str(pathlib.Path(__file__).parent))
from exchange_test import Cell, returned_late, versions_of  # noqa: E402
from mcap_file import McapFile  # noqa: E402
from nodes import end_at_exit  # noqa: E402

VERSIONS = ["gains_kept", "gains_kept", "other", "same", "back"]
CLOCKS_NS = 200_000  # a tenth of the period of press
TOPICS = ["nt::output", "nt::walked", "nt::gained", "nt::pair"]


def values_of(recording, topic):
    """(log time, bytes) of a topic, by time; of one time in the order of the file."""
    file = McapFile(recording)
    found = [(log, bytes(data)) for chunk in file.chunks for log, _, data in file.messages_of(chunk, topic)]
    return sorted(found, key=lambda one: one[0])


def last_at(values):
    """The last value of each time."""
    return dict(values)


def runs_of(recording):
    return collections.Counter((module, number, tick) for _, module, number, tick in McapFile(recording).runs())


def channels_are_single(recording):
    """One channel for one variable of one type, and for keyframes of one form."""
    file = McapFile(recording)
    seen = collections.Counter((topic, file.schemas[channel], file.metadata[channel].get("form"))
                               for channel, topic in file.topics.items())
    doubled = [key for key, count in seen.items() if count > 1]
    assert not doubled, (recording, doubled)
    assert not [key for key in seen if "_before" in key[0]], (recording, seen)


def columns_are_single(cell, recording):
    sheet = recording.with_suffix(".csv")
    done = cell.indurop("recording", "export", recording, "--csv", sheet)
    assert done.returncode == 0, done.stderr
    with open(sheet, newline="", encoding="utf-8") as lines:
        rows = csv.reader(lines)
        heading = next(rows)
        assert len(set(heading)) == len(heading), heading
        assert all(len(row) == len(heading) for row in rows)
    sheet.unlink()


def replay_of(cell, recording, *words):
    """What the replay writes, by topic; None: no module that keeps something has a keyframe in it."""
    written = recording.with_suffix(".now.mcap")
    done = cell.replay(recording, "-o", written, *words)
    if "module press" in done.stderr and "the recording has no keyframe of it" in done.stderr:
        written.unlink()
        return None
    assert done.returncode == 0 and " values: equal" in done.stdout, (recording, done.stdout, done.stderr)
    now = {topic: values_of(written, topic) for topic in TOPICS}
    written.unlink()
    return now


def judge_piece(cell, piece, whole, clocks_ns=0):
    """Each value that the replay of a piece writes is the one that the replay of the whole wrote last by then. A module that was
    not exchanged in it is repeated with the file of the configuration. Returns whether there was something to judge. `clocks_ns`:
    how far the times of two recorders may be apart, because each of them has compared the clocks."""
    versions = versions_of(cell, McapFile(piece))
    if not versions:
        return False  # the last part may have no run of it
    cell.install(versions[0][1])
    now = replay_of(cell, piece)
    for topic, values in (now or {}).items():
        then = sorted(last_at(whole[topic]).items())
        times = [log for log, _ in then]
        for log, found in values:
            first = max(bisect.bisect_right(times, log - clocks_ns) - 1, 0)
            possible = [value for _, value in then[first:bisect.bisect_right(times, log + clocks_ns)]]
            assert found in possible, (piece, topic, log, found, possible)
    return now is not None


def exchange(cell, what, has_previous):
    """`has_previous`: whether a version is in memory to which the module can return. Returns whether there is one now."""
    while True:
        done = (cell.indurop("reload", "press", "--back", "--node", cell.name) if what == "back" else
                cell.reload(what, "--health", "0s"))
        if returned_late(done.returncode, done.stderr):
            continue
        refusal = "no previous version" if what == "back" and not has_previous else "runs already"
        assert done.returncode == 0 or refusal in done.stderr, (what, has_previous, done.stdout, done.stderr)
        return what != "back" if done.returncode == 0 else has_previous


def record(cell, choice, recording, parts):
    """A recording of the whole run, and one in parts. Returns the ticks of the exchanges."""
    cell.install("same")
    live = cell.start("--record", recording)
    split = end_at_exit(subprocess.Popen([cell.bin / "indurop", "record", "-q", "--past", "--split", f"{choice.randrange(600, 1500)}ms",
                                          "--node", cell.name, "-o", parts], env=cell.environment))
    has_previous = False
    for what in ["gains_kept", "back", "gains_kept", *choice.choices(VERSIONS, k=choice.randrange(0, 3))]:
        time.sleep(choice.uniform(0.3, 0.9))
        has_previous = exchange(cell, what, has_previous)
    time.sleep(1.2)  # there are two keyframes a second
    split.send_signal(signal.SIGINT)
    split.wait()
    live.send_signal(signal.SIGTERM)
    assert live.wait() == 0, live.stderr.read()


def cut(cell, recording, name, begin_ns, end_ns):
    piece = recording.with_name(name)
    words = (["--from", f"{begin_ns}ns"] if begin_ns else []) + (["--to", f"{end_ns}ns"] if end_ns else [])
    done = cell.indurop("recording", "cut", recording, *words, "-o", piece)
    assert done.returncode == 0, (words, done.stderr)
    return piece


def join(cell, choice, pieces, name):
    joined = pieces[0].with_name(name)
    pieces = list(pieces)
    choice.shuffle(pieces)
    done = cell.indurop("recording", "join", *pieces, "-o", joined)
    assert done.returncode == 0, done.stderr
    return joined


def cut_times(choice, recording, versions):
    """Times from the beginning of the recording: at random runs, and at, before and after the first run of a version."""
    file = McapFile(recording)
    runs = sorted((log, number) for log, module, number, _ in file.runs() if module == "press")
    begin = min(log for topic in set(file.topics.values()) for chunk in file.chunks for log, _, _ in file.messages_of(chunk, topic))
    number = choice.choice([first for first, _ in versions if first > 0])
    at = next(i for i, run in enumerate(runs) if run[1] >= number)
    near = runs[min(max(at + choice.randrange(-2, 3), 1), len(runs) - 2)][0]
    times = {near - begin + choice.choice([-1, 0, 1])}
    times |= {choice.choice(runs[10:-10])[0] - begin + choice.choice([-1, 0, 1, 400_000]) for _ in range(choice.randrange(0, 3))}
    return sorted(times)


def a_recording_is_the_sum_of_its_pieces(cell, seed):
    choice = random.Random(seed)
    recording = cell.folder / f"{seed}.mcap"
    record(cell, choice, recording, cell.folder / f"{seed}.part.mcap")
    channels_are_single(recording)
    columns_are_single(cell, recording)
    whole, versions, runs = replay_of(cell, recording), versions_of(cell, McapFile(recording)), runs_of(recording)
    assert whole["nt::gained"] and whole["nt::pair"]
    for turn in range(3):
        times = cut_times(choice, recording, versions)
        borders = list(zip([0, *times], [*(time - 1 for time in times), 0]))
        pieces = [cut(cell, recording, f"{seed}.{turn}.{i}.mcap", *border) for i, border in enumerate(borders)]
        joined = join(cell, choice, pieces, f"{seed}.{turn}.mcap")
        assert runs_of(joined) == runs, (seed, times)
        for topic in TOPICS:
            assert last_at(values_of(joined, topic)).items() >= last_at(values_of(recording, topic)).items(), (seed, times, topic)
        channels_are_single(joined)
        assert replay_of(cell, joined) == whole, (seed, times)
        for piece in pieces:
            judge_piece(cell, piece, whole)
    parts = sorted(cell.folder.glob(f"{seed}.part.*.mcap"))
    assert len(parts) > 1
    for part in parts:
        channels_are_single(part)
    assert any([judge_piece(cell, part, whole, CLOCKS_NS) for part in parts]), seed
    joined = join(cell, choice, parts, f"{seed}.parts.mcap")
    channels_are_single(joined)
    columns_are_single(cell, joined)
    judge_piece(cell, joined, whole, CLOCKS_NS)
    print(f"  seed {seed}: {len(parts)} parts, {[name for _, name in versions]}")


def a_piece_may_begin_between_a_keyframe_and_its_run(cell):
    """Runs of the other module end in between: they are in the piece before, and come before the values with which this one begins."""
    recording = cell.folder / "between.mcap"
    cell.install("same")
    live = cell.start("--record", recording)
    time.sleep(3)
    live.send_signal(signal.SIGTERM)
    assert live.wait() == 0, live.stderr.read()
    file, tried = McapFile(recording), 0
    begin = min(log for topic in set(file.topics.values()) for chunk in file.chunks for log, _, _ in file.messages_of(chunk, topic))
    for keyframe in [log for chunk in file.chunks for log, _, _ in file.messages_of(chunk, "indurop/keyframes/press")]:
        end = min((log for log, module, _, _ in file.runs() if module == "press" and log > keyframe), default=0)
        between = [log for log, module, _, _ in file.runs() if module == "other" and keyframe < log < end]
        if between:
            at = max(between) + 1 - begin
            pieces = [cut(cell, recording, f"between.{at}.0.mcap", 0, at - 1), cut(cell, recording, f"between.{at}.1.mcap", at, 0)]
            assert replay_of(cell, join(cell, random.Random(at), pieces, f"joined.{at}.mcap")) == replay_of(cell, recording)
            tried += 1
    assert tried > 0


def a_variable_has_its_name_whatever_type_has_it_now(cell):
    """A part that begins after its type has changed and changed back names it as the others do, and can be replayed."""
    def install(version):
        shutil.copy(cell.modules / f"layout_{version}.so", cell.folder / "press.new")
        os.replace(cell.folder / "press.new", cell.folder / "press.so")

    recording, parts = cell.folder / "types.mcap", cell.folder / "types.part.mcap"
    install("old")
    live = end_at_exit(subprocess.Popen([cell.bin / "indurop-node", "-q", "--node", cell.name, "--record", recording,
                                         cell.configuration], env=cell.environment, stdout=subprocess.DEVNULL))
    while cell.indurop("get", "nt_layout::axis.x", "--node", cell.name).returncode != 0:
        assert live.poll() is None
    split = end_at_exit(subprocess.Popen([cell.bin / "indurop", "record", "-q", "--split", "400ms", "--node", cell.name, "-o", parts],
                                         env=cell.environment))
    for _ in range(2):
        time.sleep(0.5)
        install("wide")
        while returned_late((done := cell.indurop("reload", "press", "--health", "0s", "--node", cell.name)).returncode, done.stderr):
            pass
        assert done.returncode == 0, (done.stdout, done.stderr)
        time.sleep(0.5)
        done = cell.indurop("reload", "press", "--back", "--node", cell.name)
        assert done.returncode == 0, (done.stdout, done.stderr)
    time.sleep(1.5)
    split.send_signal(signal.SIGINT)
    split.wait()
    live.send_signal(signal.SIGTERM)
    assert live.wait() == 0
    install("old")
    for file in [recording, *sorted(cell.folder.glob("types.part.*.mcap"))]:
        channels_are_single(file)
        columns_are_single(cell, file)
        done = cell.replay(file)
        assert " values: equal" in done.stdout, (file, done.stdout, done.stderr)
        assert values_of(file, "nt_layout::axis"), file


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--modules", type=pathlib.Path, required=True)
    options = parser.parse_args()
    options.bin, options.modules = options.bin.resolve(), options.modules.resolve()
    first = int(os.environ.get("INDUROP_PARTS_SEED", random.randrange(1 << 31)))
    with tempfile.TemporaryDirectory() as folder:
        cell = Cell(options, pathlib.Path(folder).resolve())
        a_piece_may_begin_between_a_keyframe_and_its_run(cell)
        a_variable_has_its_name_whatever_type_has_it_now(cell)
        shutil.rmtree(cell.folder / "state")
        for seed in range(first, first + int(os.environ.get("INDUROP_PARTS_ROUNDS", "2"))):
            a_recording_is_the_sum_of_its_pieces(cell, seed)
    print("recordings in pieces are repeated as the whole is")


if __name__ == "__main__":
    main()
