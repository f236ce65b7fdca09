#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Losses of power: a board in QEMU counts in retained variables, is deployed to as fast as it goes, and records; its power is cut
at instants of all kinds, and its disk loses what was not flushed. After each cut it has to come back on its own: with the
deployment that was committed or the one that was under way, with retained values that are whole and not older than what was
to be saved, and with recordings that can be read. INDUROP_CUTS is their number (Ctrl-C ends them earlier), INDUROP_SEED where
the dice begin."""

import argparse
import collections
import os
import pathlib
import queue
import random
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "proof"))
import guest  # noqa: E402  pylint: disable=wrong-import-position

from cached_disk import CachedDisk  # noqa: E402  pylint: disable=wrong-import-position

SKIPPED = 77
HOST_IS_BUSY = 1200  # seconds until something has to happen in a translated machine
DISK = 192 << 20
MOST_UNSEEN = 6000  # runs before a value is called garbage
SAVED_AFTER = 125  # runs, 2.5 s: values are saved each second
READY = "the drivers are loaded"
INIT = """#!/bin/busybox sh
/bin/busybox --install -s /bin
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t devtmpfs dev /dev
mkdir -p /dev/shm /tmp
mount -t tmpfs tmp /dev/shm && chmod 1777 /dev/shm
mount -t tmpfs tmp /tmp
ip link set lo up
ip route add 224.0.0.0/4 dev lo
export PATH=/bin
cd /drivers
for driver in %s; do insmod $driver.ko; done
stty -echo
echo "%s"
read go
insmod virtio_blk.ko
while [ ! -e /dev/vda ]; do sleep 0.1; done
exec sh /test/test.sh 2>&1
"""
PLANT = """<plant name="cuts"><board name="b"><module><name>main</name><filename>./target_counting.so</filename>
<moduletype>thread</moduletype><operationtype>periodic</operationtype><period>20ms</period><budget>60s</budget><priority>1</priority>
<property><value name="data">data.bin</value></property></module></board></plant>
"""
# When power is cut: so many seconds, at most, after the agent has said this; "" is its first line after the boot.
INSTANTS = (("", 3.0), ("running 1 modules", 4.0), ("fetching", 1.5), ("switching", 2.0), ("committed", 0.5))


class Machine:
    """The guest. Its kernel boots once; each life begins with a copy of its memory from before it has seen the disk."""

    def __init__(self, root, folder, disk_socket):
        self.folder = folder
        self.command = [
            "qemu-system-x86_64", "-M", "q35,accel=tcg", "-cpu", "max", "-smp", "1", "-m", "512", "-display", "none", "-nic", "none",
            "-no-reboot", "-rtc", "base=2026-01-01,clock=vm", "-icount", "shift=2,sleep=off",
            "-drive", f"if=virtio,format=raw,cache=writeback,file=nbd+unix:///?socket={disk_socket}",
            "-kernel", str(guest.kernel()), "-initrd", str(root),
            "-append", "console=ttyS0 quiet panic=-1 mitigations=off nokaslr no_timer_check LD_LIBRARY_PATH=/lib"]
        self.process = None
        self.lines = queue.Queue()
        self.memory = folder / "memory"
        self._start(["-monitor", f"unix:{folder}/monitor,server=on,wait=off"])
        self.wait_for(READY)
        self._save_memory()

    def _start(self, words):
        # pylint: disable-next=consider-using-with
        self.process = subprocess.Popen([*self.command, "-serial", "stdio", *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT)
        self.lines = queue.Queue()
        threading.Thread(target=self._read, args=(self.process.stdout, self.lines), daemon=True).start()

    @staticmethod
    def _read(output, lines):
        for line in output:
            lines.put(line.decode(errors="replace").strip())
        lines.put(None)

    def _save_memory(self):
        with socket.socket(socket.AF_UNIX) as monitor:
            monitor.connect(f"{self.folder}/monitor")
            monitor.sendall(f'migrate "exec:cat >{self.memory}"\n'.encode())
            text = ""
            while "completed" not in text:
                time.sleep(0.2)
                monitor.sendall(b"info migrate\n")
                text += monitor.recv(65536).decode(errors="replace")
        self.cut()

    def begin(self):
        self._start(["-monitor", "none", "-incoming", f"exec:cat {self.memory}"])
        time.sleep(0.5)  # a key that is typed before the memory is there would be lost; begin() is repeated by line() then
        self.process.stdin.write(b"go\n")
        self.process.stdin.flush()

    def line(self, seconds):
        """The next line; None if there is none for so long. The end of the guest is an error."""
        try:
            line = self.lines.get(timeout=max(seconds, 0))
        except queue.Empty:
            return None
        if line is None:
            raise RuntimeError("the guest has ended on its own")
        return line

    def wait_for(self, text):
        end = time.monotonic() + HOST_IS_BUSY
        while True:
            line = self.line(end - time.monotonic())
            if line is None:
                raise RuntimeError(f"the guest did not say: {text}")
            if text in line:
                return

    def cut(self):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()


class Judge:
    """What was seen of the board over all its lives."""

    def __init__(self, talks):
        self.committed = ""  # the deployment, by the first 12 digits of its id
        self.under_way = ""
        self.newest = 0  # runs that were seen
        self.saved = 0  # runs that must be there after the cut
        self.begun = set()  # recordings that must be readable after the cut
        self.count = collections.Counter()
        self.findings = []
        self.was = ""
        self.talks = talks

    def wrong(self, text):
        self.findings.append(f"after {self.was}: {text}")
        print(f"    WRONG {text}", flush=True)

    def hear(self, line):
        if self.talks:
            print(f"      {line}", flush=True)
        kind, _, text = line.partition(" ")
        found = re.search(r"deployment ([0-9a-f]{12})(?: of \S+)?: (\w+)", text)
        if kind == "F":
            self.wrong(text)
        elif kind in ("B", "I", "E"):
            self.recording(kind, text)
        elif kind == "R":
            self.values(text)
        elif kind == "D":
            self.resumed(text.strip()[:12])
        elif kind == "L":
            self.count["most deployments kept"] = max(self.count["most deployments kept"], int(text.split()[0]))
        elif kind == "N" and self.committed:
            self.wrong(f"nothing is deployed, {self.committed} was committed")
        elif kind == "A" and text.startswith("run "):
            self.newest = max(self.newest, int(text.split()[1]))
        elif kind == "A" and found:
            self.deployment(*found.groups())

    def deployment(self, number, step):
        if step == "fetching":
            self.under_way = number
        elif step == "committed":
            self.committed, self.under_way = number, ""
            self.count["commits"] += 1
        elif step in ("rolling", "abandoned"):
            self.under_way = ""

    def resumed(self, number):
        if number not in (self.committed, self.under_way):
            self.wrong(f"{number} runs, committed was {self.committed or 'none'}, under way {self.under_way or 'none'}")
        self.count["new" if number == self.under_way else "old"] += 1
        self.committed, self.under_way = number, ""

    def recording(self, kind, text):
        """One that has just begun may be lost; "I" alone ends the list."""
        if kind == "B":
            self.begun.add(text)
        elif kind == "I" and text:
            self.count["recordings read"] += 1
            self.begun.discard(text)
        elif kind == "E" and text.split()[0] not in self.begun:
            self.count["recordings lost in their first seconds"] += 1
        elif kind == "I":
            for name in self.begun:
                self.wrong(f"recording {name} cannot be read")
            self.begun.clear()

    def values(self, text):
        runs = [int(number) for number in text.split()]
        if len(runs) != 33 or len(set(runs[:-1])) != 1 or not runs[0] - 1 <= runs[-1] <= runs[0]:
            self.wrong(f"retained values are torn: {text}")
        if runs[0] < self.saved:
            self.wrong(f"retained values went back to {runs[0]}, {self.saved} was saved")
        if runs[0] > self.newest + MOST_UNSEEN:
            self.wrong(f"retained values are {runs[0]}, the newest seen was {self.newest}")
        self.newest = max(self.saved, runs[0])

    def cut(self, was):
        self.was = was
        self.saved = max(self.saved, self.newest - SAVED_AFTER)


def live(machine, judge, instant, delay):
    """One life, to its cut. It has to come back before that, unless the cut is in the boot."""
    machine.begin()
    came_back = not judge.committed
    end = time.monotonic() + HOST_IS_BUSY
    cut_at = None
    while True:
        now = time.monotonic()
        if cut_at is not None and now >= cut_at:
            return
        if now >= end:
            judge.wrong(f"nothing more happens: {'it came back' if came_back else 'it did not come back'}")
            return
        line = machine.line(min(cut_at or end, end) - now)
        if line is None:
            continue
        judge.hear(line)
        came_back = came_back or line.startswith("D ")
        of_agent = line.startswith("A ")
        if cut_at is None and of_agent and (instant == "" or (came_back and instant in line)):
            cut_at = time.monotonic() + delay


def prove(folder, bin_folder, module, cuts, seed):
    dice = random.Random(seed)
    with guest.Guest([bin_folder / name for name in ("indurop", "indurop-agent", "indurop-node")],
                     INIT % (" ".join(guest.DRIVERS[:-1]), READY)) as made:
        made.add(module)
        made.add_drivers()
        (made.root / "test" / "plant.xml").write_text(PLANT)
        root = made.pack(pathlib.Path(__file__).with_name("board_life.sh").read_text())
        image = folder / "disk"
        subprocess.run(["mke2fs", "-q", "-F", "-t", "ext4", image, f"{DISK // 1024}"], check=True)
        disk = CachedDisk(str(folder / "disk.socket"), image.read_bytes())
        machine = Machine(root, folder, folder / "disk.socket")
        disk.cut(dice)
        judge = Judge("INDUROP_CUTS_TALK" in os.environ)
        began = time.monotonic()
        done = 0
        try:
            for number in range(cuts):
                instant, most = dice.choice(INSTANTS if judge.committed else INSTANTS[2:])
                delay = dice.uniform(0, most)
                live(machine, judge, instant, delay)
                machine.cut()
                cached, kept = disk.cut(dice)
                was = f"cut {number + 1}, {delay:.2f} s after '{instant or 'the start of the agent'}', {kept} of {cached} sectors kept"
                judge.cut(was)
                done = number + 1
                judge.count["sectors lost"] += cached - kept
                print(f"{was}; {(time.monotonic() - began) / (number + 1):.0f} s per cut", flush=True)
                if judge.findings and os.environ.get("INDUROP_CUTS_KEEP"):
                    pathlib.Path(os.environ["INDUROP_CUTS_KEEP"]).write_bytes(disk.safe)
                    break
            # After the last one it has to come back as well.
            live(machine, judge, "running 1 modules", 0)
            machine.cut()
            disk.cut(dice)
        except KeyboardInterrupt:
            print("interrupted")
        finally:
            machine.cut()
        image.write_bytes(disk.safe)
        judged = subprocess.run(["e2fsck", "-fy", image], capture_output=True, text=True, check=False)
        if judged.returncode not in (0, 1):
            judge.wrong(f"e2fsck: {judged.stdout[-300:]}")
    print(f"{done} cuts from seed {seed}: {dict(judge.count)}, {disk.flushes} flushes")
    print("\n".join(judge.findings) or "nothing wrong")
    return not judge.findings


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--module", type=pathlib.Path, required=True)
    parser.add_argument("--cuts", type=int, default=int(os.environ.get("INDUROP_CUTS", "10")))
    parser.add_argument("--seed", type=int, default=int(os.environ.get("INDUROP_SEED", "1")))
    options = parser.parse_args()
    why = guest.missing()
    if why:
        print(f"skipped: {why}")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="indurop-cuts-") as folder:
        sys.exit(0 if prove(pathlib.Path(folder), options.bin, options.module, options.cuts, options.seed) else 1)


if __name__ == "__main__":
    main()
