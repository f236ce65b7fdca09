# SPDX-License-Identifier: Apache-2.0
"""A machine with one ARM64 processor and Debian's PREEMPT_RT kernel, on x86-64. Its disk is the Debian of
cmake/arm64_root.sh, in which this runs: the libraries of arm64 lie there next to those of amd64, whose programs it cannot
run, so busybox takes their place.
machine.py FOLDER FD: a machine in real time that runs FOLDER/test.sh until it is killed; the file descriptor FD is its network."""

import contextlib
import lzma
import pathlib
import subprocess
import sys
import tempfile

KERNEL = pathlib.Path("/kernel")  # Debian's package, not installed
# In the order in which they are loaded.
DRIVERS = ("netfs", "9pnet", "9pnet_virtio", "9p", "failover", "net_failover", "virtio_net")

INIT = """#!/bin/busybox sh
/bin/busybox --install -s /bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
for driver in {drivers}; do insmod /drivers/$driver.ko; done
mount -t 9p -o ro,trans=virtio,version=9p2000.L,cache=loose,msize=512000 root /root
mount -t 9p -o trans=virtio,version=9p2000.L,msize=512000 out /root/mnt
for folder in proc sys dev; do mount --move /$folder /root/$folder; done
for folder in tmp run dev/shm; do mkdir -p /root/$folder; mount -t tmpfs -o mode=1777 tmp /root/$folder; done
ln -s /proc/self/fd/0 /root/dev/stdin; ln -s /proc/self/fd/1 /root/dev/stdout; ln -s /proc/self/fd/2 /root/dev/stderr
mkdir /root/dev/pts && mount -t devpts pts /root/dev/pts
mount --bind /bin/busybox /root/usr/bin/dash
mount --bind /bin /root/srv
ip link set lo up
PATH=/srv:/usr/bin chroot /root /srv/sh /mnt/test.sh
poweroff -f
"""


def disk(folder):
    """The first RAM disk: what it takes to mount the other one."""
    root = folder / "root"
    for name in ("bin", "proc", "sys", "dev", "root", "drivers"):
        (root / name).mkdir(parents=True)
    (root / "bin/busybox").write_bytes(pathlib.Path("/bin/busybox").read_bytes())
    (root / "bin/busybox").chmod(0o755)
    for name in DRIVERS:
        found = next((KERNEL / "lib/modules").rglob(f"{name}.ko.xz"))
        (root / "drivers" / f"{name}.ko").write_bytes(lzma.decompress(found.read_bytes()))
    (root / "init").write_text(INIT.format(drivers=" ".join(DRIVERS)))
    (root / "init").chmod(0o755)
    packed = folder / "disk.cpio"
    with open(packed, "wb") as out:
        subprocess.run("find . | cpio --quiet -o -H newc", shell=True, cwd=root, stdout=out, check=True)
    return packed


def share(tag, path, more):
    return ["-virtfs", f"local,path={path},mount_tag={tag},security_model=none,multidevs=remap{more}"]


def command(folder, reports, more):
    return ["qemu-system-aarch64", "-M", "virt,accel=tcg,gic-version=3", "-cpu", "cortex-a72", "-smp", "1", "-m", "2048",
            "-nographic", "-no-reboot", "-kernel", next((KERNEL / "boot").glob("vmlinuz-*")), "-initrd", disk(pathlib.Path(folder)),
            "-append", "console=ttyAMA0 quiet panic=-1", *share("root", "/", ",readonly=on"), *share("out", reports, ""), *more]


def run(script, reports, shift, seconds):
    """Runs the shell script; it writes into /mnt, which is the folder `reports` here. Each instruction takes 2^shift ns: more of
    them make waits that count the time cheaper. `seconds` of this machine's time are a hang."""
    (reports / "test.sh").write_text(script)
    counted = ["-nic", "none", "-rtc", "clock=vm", "-icount", f"shift={shift},sleep=off"]
    with tempfile.TemporaryDirectory() as folder, open(reports / "console.log", "wb") as console:
        with contextlib.suppress(subprocess.TimeoutExpired):
            subprocess.run(command(folder, reports, counted), stdin=subprocess.DEVNULL, stdout=console, stderr=console,
                           timeout=seconds, check=False)


if __name__ == "__main__":
    wire = int(sys.argv[2])
    with tempfile.TemporaryDirectory() as own:
        subprocess.run(command(own, sys.argv[1], ["-netdev", f"tap,id=wire,fd={wire}", "-device", "virtio-net-pci,netdev=wire,romfile="]),
                       stdin=subprocess.DEVNULL, pass_fds=[wire], check=False)
