#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A virtual machine with Debian's PREEMPT_RT kernel and counted time: each instruction takes 1 ns, and the time of the
host, its stalls too, does not exist in it. It is one processor, a RAM disk and a shell script; what the script puts
into /out comes back."""

import lzma
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

KERNEL_PACKAGE = "linux-image-6.12-rt-amd64"  # names the newest one
TOOLS = ("qemu-system-x86_64", "busybox", "cpio", "cyclictest")
CABLE = "veth"  # a driver: a pair of network interfaces
BEGIN, END = "===== out", "===== end"

INIT = """#!/bin/busybox sh
/bin/busybox --install -s /bin
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t devtmpfs dev /dev
mkdir -p /dev/shm /tmp /out /run
mount -t tmpfs tmp /dev/shm && chmod 1777 /dev/shm
mount -t tmpfs tmp /tmp
ip link set lo up 2>/dev/null
export PATH=/bin HOME=/tmp
cd /test && sh ./test.sh >/out/log 2>&1
echo $? >/out/code
stty raw -echo 2>/dev/null
echo "%s"
tar -cz -C /out . | uuencode -m out
echo "%s"
poweroff -f
""" % (BEGIN, END)


def cache():
    base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    return pathlib.Path(base) / "indurop" / "guest"


def kernel():
    """The kernel that was fetched, None if none was."""
    found = sorted((cache() / "boot").glob("vmlinuz-*-rt-amd64"))
    return found[-1] if found else None


def is_fetched():
    return kernel() is not None and (cache() / "drivers" / f"{CABLE}.ko").exists()


def missing():
    """Why there can be no guest here; empty: there can."""
    tools = [tool for tool in TOOLS if not shutil.which(tool)]
    if tools:
        return f"{', '.join(tools)} not found; make rt-proof installs what is missing"
    return "" if is_fetched() else f"no kernel in {cache()}; make rt-proof fetches it"


def fetch_kernel():
    """Debian's package of the kernel into our own folder: it is not installed, for this machine boots another one."""
    if is_fetched():
        return
    listed = subprocess.run(["apt-cache", "depends", KERNEL_PACKAGE], capture_output=True, text=True, check=True).stdout
    name = re.search(r"Depends: (linux-image-\S+)", listed).group(1)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["apt-get", "-qq", "download", name], cwd=folder, check=True)
        package = next(pathlib.Path(folder).glob("*.deb"))
        subprocess.run(["dpkg-deb", "-x", package, folder + "/x"], check=True)
        for name in ("boot", "drivers"):
            (cache() / name).mkdir(parents=True, exist_ok=True)
        packed = next(pathlib.Path(folder, "x/lib/modules").rglob(f"{CABLE}.ko.xz"))
        (cache() / "drivers" / f"{CABLE}.ko").write_bytes(lzma.decompress(packed.read_bytes()))
        for file in pathlib.Path(folder, "x", "boot").glob("vmlinuz-*"):
            shutil.copy(file, cache() / "boot" / (file.name + ".part"))
            (cache() / "boot" / (file.name + ".part")).rename(cache() / "boot" / file.name)


def libraries(files):
    """What these programs and modules load, by the host's dynamic linker."""
    found = set()
    for file in files:
        listed = subprocess.run(["ldd", file], capture_output=True, text=True, check=False).stdout
        found.update(re.findall(r"(?:=> )?(/\S+) \(0x", listed))
    return found


class Guest:
    """What is in the RAM disk. Programs lie in /bin, files of a test in /test."""

    def __init__(self, programs):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="indurop-guest-"))
        self.root = self.folder / "root"
        for name in ("bin", "lib64", "lib", "proc", "sys", "dev", "tmp", "out", "test", "run"):
            (self.root / name).mkdir(parents=True)
        self.stripped(shutil.which("busybox"), "bin/busybox")
        for program in programs:
            self.stripped(program, f"bin/{os.path.basename(program)}")
        self.load(programs)
        (self.root / "init").write_text(INIT)
        (self.root / "init").chmod(0o755)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder)

    def stripped(self, file, name):
        target = self.root / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if subprocess.run(["objcopy", "--strip-unneeded", file, target], capture_output=True, check=False).returncode != 0:
            shutil.copy(file, target)

    def load(self, files):
        for library in libraries(files):
            # /lib is /usr/lib on Debian: one folder for all of them, and the dynamic linker where programs look for it.
            where = "lib64" if "/ld-linux" in library else "lib"
            if not (self.root / where / os.path.basename(library)).exists():
                self.stripped(library, f"{where}/{os.path.basename(library)}")

    def add(self, file, name=None):
        """A file of the test; with what it loads, if it is a program or module."""
        self.stripped(file, f"test/{name or os.path.basename(file)}")
        self.load([file])

    def add_drivers(self):
        shutil.copytree(cache() / "drivers", self.root / "drivers")

    def _pack(self, script):
        (self.root / "test" / "test.sh").write_text(script)
        disk = self.folder / "disk.cpio"
        with open(disk, "wb") as out:
            subprocess.run("find . | cpio --quiet -o -H newc", shell=True, cwd=self.root, stdout=out, check=True)
        return disk

    def run(self, script, seconds):
        """What the script left in /out, by name, and the serial console's text. `seconds` of wall time are a hang."""
        disk = self._pack(script)
        console = subprocess.run(
            ["qemu-system-x86_64", "-M", "q35,accel=tcg", "-cpu", "max", "-smp", "1", "-m", "1024", "-nographic",
             "-no-reboot", "-nic", "none", "-rtc", "base=2026-01-01,clock=vm", "-icount", "shift=0,sleep=off",
             "-kernel", kernel(), "-initrd", disk, "-append",
             "console=ttyS0 quiet panic=-1 mitigations=off nokaslr LD_LIBRARY_PATH=/lib"],
            stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", timeout=seconds, check=False).stdout
        return self.files(console), console

    def files(self, console):
        packed = re.search(f"{BEGIN}\r?\n(.*?){END}", console.replace("\r", ""), re.DOTALL)
        if not packed:
            return {}
        (self.folder / "out.uu").write_text(packed.group(1))
        subprocess.run(["busybox", "uudecode", "-o", self.folder / "out.tgz", self.folder / "out.uu"], check=True)
        with tarfile.open(self.folder / "out.tgz") as tar:
            return {member.name.removeprefix("./"): tar.extractfile(member).read().decode(errors="replace")
                    for member in tar.getmembers() if member.isfile()}


if __name__ == "__main__":
    if sys.argv[1:] == ["fetch"]:
        fetch_kernel()
    print(missing() or f"ready: {kernel()}")
