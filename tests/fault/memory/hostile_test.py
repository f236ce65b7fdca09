#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every program that reads the memory of nodes, with what a stranger may leave there: blocks of a plant that ran, mutated, cut, and
cut while they are read. No program may die of a signal or hang. hostile_test.py PROGRAMS PLANT_FOLDER [TEST...]

INDUROP_HOSTILE_ROUNDS (default 12) and INDUROP_HOSTILE_SEED choose more and other mutations."""

import fcntl
import http.client
import os
import pathlib
import random
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import traceback

SHM = pathlib.Path("/dev/shm")
HANG_S = 120  # only tells what hangs from what is slow
ROUNDS = int(os.environ.get("INDUROP_HOSTILE_ROUNDS", "12"))
SEED = int(os.environ.get("INDUROP_HOSTILE_SEED", "1"))
OWN_MEMORY = ["unshare", "--mount", "--net", "--propagation", "private", "sh", "-c",
              'mount -t tmpfs -o mode=1777,size=512m none /dev/shm && ip link set lo up && exec "$0" "$@"']
EVIL = "evil"
BOUNDARIES = [0, 1, 2, 3, 7, 0x7F, 0xFF, 0x7FFF, 0xFFFF, 1000147, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 1 << 40, (1 << 63) - 1,
              1 << 63, (1 << 64) - 1, (1 << 64) - 63]
LOOKS = [
    ["nodes"], ["nodes", "--all", "-o", "json"],
    ["status"], ["status", "-o", "json"], ["vars"], ["vars", "-o", "json"], ["get", "cell::torque"], ["typeof", "cell::torque"],
    ["get", "cell::encoder", "-o", "json"], ["watch", "*", "-n", "2", "--hz", "100", "--timeout", "500ms"],
    ["hz", "cell::torque", "--timeout", "200ms"], ["jitter"], ["jitter", "-o", "json"], ["overruns"], ["log"],
    ["log", "--trace", "{folder}/trace.json"], ["explain", "controller"], ["explain", "controller", "--tick", "7"],
    ["explain", "cell::torque"], ["explain", "cell::encoder"], ["explain", "sensor"], ["blackbox"], ["alarms", "--all"],
    ["age", "cell::encoder", "cell::torque", "--duration", "100ms"],
    ["scope", "cell::torque", "--past", "-n", "1", "--post", "5", "--pre", "5", "--timeout", "300ms"],
    ["record", "-o", "{folder}/{number}.mcap", "--past", "--duration", "100ms"],
]
ROUTES = ["", "/modules", "/modules/controller/histograms", "/schedule", "/runs", "/overruns", "/messages", "/faults", "/variables",
          "/variables/cell::torque", "/forces", "/alarms", "/robots", "/plc"]


def own_start():
    return int(pathlib.Path("/proc/self/stat").read_text().rsplit(")", 1)[1].split()[19])


class Setting:
    def __init__(self, programs, plant):
        self.programs, self.plant = pathlib.Path(programs), pathlib.Path(plant)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hostile_test_"))
        self.environment = dict(os.environ, INDUROP_STATE_DIR=str(self.folder / "state"))
        self.environment.pop("INDUROP_NODE", None)
        self.number = 0
        self.children = []
        self.lock = None

    def start(self, *words, **more):
        child = subprocess.Popen([str(word) for word in words], env=self.environment, text=True, **more)
        self.children.append(child)
        return child

    def indurop(self, *words):
        """Runs to its end; the exit code is one of those that are documented."""
        self.number += 1
        words = [word.format(folder=self.folder, number=self.number) for word in words]
        done = subprocess.run([self.programs / "indurop", *words], env=self.environment, timeout=HANG_S, capture_output=True,
                              text=True, errors="replace", check=False)
        assert done.returncode in (0, 1, 2, 4, 6, 8), f"{words}: exit code {done.returncode}\n{done.stdout[-500:]}\n{done.stderr[-2000:]}"
        return done

    def look(self, *words):
        own = ["--node", EVIL] if words[0] not in ("nodes", "blackbox") else []
        return self.indurop(*words, *own)

    def take_name(self):
        """This process is the node of the name, as far as the lock tells."""
        self.lock = open(SHM / f"indurop.{EVIL}.lock", "w", encoding="ascii")
        fcntl.flock(self.lock, fcntl.LOCK_EX)
        self.lock.write(f"{os.getpid()} {own_start()}\n")
        self.lock.flush()

    def clean(self):
        for child in self.children:
            if child.poll() is None:
                child.kill()
            child.wait()
        if self.lock:
            self.lock.close()
        for file in SHM.glob("indurop.*"):
            file.unlink()
        shutil.rmtree(self.folder)


def wait_for(condition, what):
    end = time.monotonic() + HANG_S
    while time.monotonic() < end:
        if value := condition():
            return value
        time.sleep(0.02)
    raise AssertionError(f"waited in vain for {what}")


def blocks_of_a_plant(setting):
    """What the board `control` leaves when it is killed in mid-run: each kind of block, by the end of its name, as `evil`'s."""
    setting.start(setting.programs / "indurop", "run", setting.plant / "plant.xml", "--local", stdout=subprocess.DEVNULL)
    # It has heard the other one, and the tape has something to tell.
    wait_for(lambda: "alive" in setting.indurop("status", "--node", "control").stdout, "the board")
    wait_for(lambda: len(setting.indurop("log", "--node", "control", "-o", "csv").stdout.splitlines()) > 30, "runs")
    pid, start = (int(word) for word in (SHM / "indurop.control.lock").read_text().split())
    setting.indurop("force", "--node", "control", "cell::target", "1", "--for", "1h")
    blocks = {}
    for file in SHM.glob("indurop.control*"):
        end = file.name.removeprefix("indurop.control")
        if end != ".lock":
            blocks[end] = file.read_bytes()
    for child in setting.children:
        child.send_signal(signal.SIGTERM)
        child.wait(HANG_S)
    setting.children.clear()
    for file in SHM.glob("indurop.*"):
        file.unlink()
    assert {"", ".run", ".tape", ".mirror", ".custody", ".kernel", ".batch"} <= blocks.keys(), blocks.keys()
    setting.take_name()
    for end in ("", ".run"):  # their node is this process
        head = blocks[end][:1024].replace(struct.pack("<i", pid), struct.pack("<i", os.getpid()))
        head = head.replace(struct.pack("<Q", start), struct.pack("<Q", own_start()))
        blocks[end] = head + blocks[end][1024:]
    return blocks


def put(end, content):
    """Under a new inode, so that a process that still maps the old one is not misled."""
    path = SHM / f"indurop.{EVIL}{end}"
    new = SHM / f"indurop-new-{os.getpid()}"
    new.write_bytes(content)
    new.rename(path)


def damage(content, chance):
    """Some bytes, numbers or a cut; half of them near the begin, where what leads elsewhere stands."""
    mutated = bytearray(content)
    for _ in range(chance.choice([1, 1, 2, 5, 20])):
        reach = len(mutated) if chance.random() < 0.5 else min(len(mutated), 2048)
        kind = chance.random()
        if kind < 0.35:
            mutated[chance.randrange(reach)] = chance.randrange(256)
        elif kind < 0.65 and reach >= 8:
            struct.pack_into("<Q", mutated, chance.randrange(reach // 8) * 8, chance.choice(BOUNDARIES) & (2**64 - 1))
        elif kind < 0.95 and reach >= 4:
            struct.pack_into("<I", mutated, chance.randrange(reach // 4) * 4, chance.choice(BOUNDARIES) & 0xFFFFFFFF)
        elif len(mutated) > 1:
            del mutated[chance.choice([chance.randrange(1, len(mutated)), len(mutated) // 4096 * 4096 // 2]):]
            mutated = mutated or bytearray(1)
    return bytes(mutated)


def start_server(setting, *options):
    child = setting.start(setting.programs / "indurop-serve", "--port", 0, *options, stdout=subprocess.PIPE)
    return child, int(re.match(r"https?://[^/]*:(\d+)/", child.stdout.readline()).group(1))


def ask(port, path):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=HANG_S)
    try:
        connection.request("GET", path)
        answer = connection.getresponse()
        return answer.status, answer.read()
    finally:
        connection.close()


def ask_all(server, port):
    for route in ["/api/v1/boards", *[f"/api/v1/boards/{EVIL}{route}" for route in ROUTES]]:
        try:
            status, _ = ask(port, route)
        except (http.client.HTTPException, ConnectionError) as error:
            raise AssertionError(f"{route}: {error}; indurop-serve has ended with {server.wait(HANG_S)}") from error
        assert status in (200, 404, 409, 500, 503, 504), (route, status)


def test_blocks_as_they_are_show_a_node(setting):
    """Otherwise the mutations would be of bytes that no program reads."""
    blocks = blocks_of_a_plant(setting)
    for end, content in blocks.items():
        put(end, content)
    assert f"{EVIL}  running" in setting.look("status").stdout.replace("hung", "running")
    assert setting.look("get", "cell::torque").returncode == 0
    for words in LOOKS:
        setting.look(*words)


def test_mutated_blocks(setting):
    blocks = blocks_of_a_plant(setting)
    chance = random.Random(SEED)
    server, port = start_server(setting, "--node", EVIL)
    for number in range(ROUNDS):
        for end, content in blocks.items():
            put(end, content)
        kinds = [chance.choice(list(blocks))] if number % 3 else list(blocks)
        for end in kinds:
            put(end, damage(blocks[end], chance))
        if ROUNDS > 100 or number % 2 == 0:
            for end in kinds:
                (setting.folder / f"last{end}").write_bytes((SHM / f"indurop.{EVIL}{end}").read_bytes())
        for words in chance.sample(LOOKS, 9) if ROUNDS <= 100 else LOOKS:
            try:
                setting.look(*words)
            except Exception:
                print(f"round {number} of seed {SEED}: {kinds}")
                raise
        ask_all(server, port)
        assert server.poll() is None, f"indurop-serve ended with {server.returncode} in round {number} of seed {SEED}: {kinds}"


def test_blocks_that_change_and_are_cut_while_they_are_read(setting):
    blocks = blocks_of_a_plant(setting)
    chance = random.Random(SEED)
    for end, content in blocks.items():
        put(end, content)
    server, port = start_server(setting, "--node", EVIL)
    over = threading.Event()

    def spoil():
        while not over.is_set():
            end = chance.choice(list(blocks))
            content = blocks[end]
            path = SHM / f"indurop.{EVIL}{end}"
            if chance.random() < 0.1:
                put(end, content)
                continue
            with open(path, "r+b") as file:
                for _ in range(chance.randrange(1, 30)):
                    kind = chance.random()
                    if kind < 0.2:
                        file.truncate(chance.choice([0, 1, chance.randrange(len(content)), 4096]))
                    elif kind < 0.5:
                        file.seek(0)
                        file.write(content)
                    else:
                        file.seek(chance.randrange(min(len(content), 4096)) // 8 * 8)
                        file.write(struct.pack("<Q", chance.choice(BOUNDARIES) & (2**64 - 1)))
                    file.flush()

    spoiler = threading.Thread(target=spoil)
    spoiler.start()
    long = {}
    try:
        for words in (["watch", "*", "--hz", "200"], ["scope", "cell::torque"], ["record", "-o", f"{setting.folder}/live.mcap"]):
            long[words[0]] = setting.start(setting.programs / "indurop", *words, "--node", EVIL, stdout=subprocess.DEVNULL,
                                           stderr=subprocess.DEVNULL)
        for _ in range(max(ROUNDS // 4, 1)):
            for words in chance.sample(LOOKS, 8):
                setting.look(*words)
            ask_all(server, port)
            assert server.poll() is None, f"indurop-serve ended with {server.returncode}"
    finally:
        over.set()
        spoiler.join()
    for name, child in long.items():
        if child.poll() is None:
            child.send_signal(signal.SIGTERM)
        assert child.wait(HANG_S) in (0, 1, 6, 8, 130, 143), f"{name} ended with {child.returncode}"
    server.send_signal(signal.SIGTERM)
    assert server.wait(HANG_S) in (0, 143), server.returncode


def test_files_of_zeros_block_no_program(setting):
    """As many as would take minutes, if each were waited for."""
    for number in range(300):
        (SHM / f"indurop.sq{number}").write_bytes(bytes(4096))
    began = time.monotonic()
    assert setting.indurop("nodes").returncode == 0
    print(f"        nodes with 300 files of zeros: {time.monotonic() - began:.2f} s")
    _, port = start_server(setting)
    assert ask(port, "/api/v1/boards")[0] == 200


def test_a_copied_block_does_not_run(setting):
    setting.start(setting.programs / "indurop", "run", setting.plant / "plant.xml", "--local", stdout=subprocess.DEVNULL)
    wait_for(lambda: "running" in setting.indurop("status", "--node", "control").stdout, "the board")
    for end in ("", ".run"):
        (SHM / f"indurop.copy{end}").write_bytes((SHM / f"indurop.control{end}").read_bytes())
    listed = setting.indurop("nodes", "-o", "csv").stdout
    assert "control,running" in listed and "copy" not in listed, listed
    assert "not running" in setting.indurop("watch", "--node", "copy", "--once", "cell::torque").stderr


def main():
    if "--inside" not in sys.argv:
        for more in ([], ["--user", "--map-root-user"]):
            words = [OWN_MEMORY[0], *more, *OWN_MEMORY[1:]]
            if shutil.which("unshare") and subprocess.run([*words, "true"], stderr=subprocess.DEVNULL, check=False).returncode == 0:
                os.execvp(words[0], [*words, sys.executable, *sys.argv, "--inside"])
        print("skipped: this system does not allow a private /dev/shm (namespaces)")
        sys.exit(77)
    _, programs, plant, *names = [word for word in sys.argv if word != "--inside"]
    failed = []
    for name, test in list(globals().items()):
        if not name.startswith("test_") or (names and name not in names):
            continue
        setting = Setting(programs, plant)
        began = time.monotonic()
        try:
            test(setting)
            print(f"ok      {name} ({time.monotonic() - began:.1f} s)", flush=True)
        except Exception:  # the next test is run all the same
            failed.append(name)
            print(f"FAILED  {name}", flush=True)
            traceback.print_exc(file=sys.stdout)
        finally:
            setting.clean()
    sys.exit(f"failed: {', '.join(failed)}" if failed else 0)


if __name__ == "__main__":
    main()
