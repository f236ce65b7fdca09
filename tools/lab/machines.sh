# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh disable=SC2154 # lab, here, parts, switch, cores, counted and bare are indurop-lab's
# Boards as virtual machines: read by indurop-lab. Debian with its PREEMPT_RT kernel and systemd, made once by mmdebstrap and
# kept; a board has a disk of its own on top of it, a hardware watchdog, a card on the lab's switch and a second one that only
# exec uses.

kernel_package=linux-image-6.12-rt-amd64
packages="systemd-sysv udev dbus iproute2 iptables kmod procps openssh-server initramfs-tools busybox $kernel_package"
images=${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/indurop/lab
machines=/var/tmp/indurop-lab/$lab
door_ports=22000 # + the board's number, on the switch's own loopback

is_machine() { [ -d "$machines/$1" ]; }
is_on() { [ -f "$machines/$1/pid" ] && tr '\0' '\n' <"/proc/$(cat "$machines/$1/pid")/cmdline" 2>/dev/null | grep -qx "$switch.$1"; }
fact() { cat "$machines/$1/$2"; }

# Hardware that can run virtual machines on its own; a device file alone is not proof.
has_kvm() { [ -w /dev/kvm ] && grep -q -m1 -E '^flags.* (vmx|svm)( |$)' /proc/cpuinfo; }

need() {
  for tool in "$@"; do
    command -v "$tool" >/dev/null && continue
    case $tool in
      qemu-*) package=qemu-system-x86 ;;
      ssh | ssh-keygen) package=openssh-client ;;
      mke2fs) package=e2fsprogs ;;
      *) package=$tool ;;
    esac
    die "the command $tool is missing; install $package"
  done
}

# Where the host's programs are: next to this one, or in the path.
programs() {
  found=$here/indurop-agent
  [ -x "$found" ] || found=$(command -v indurop-agent) || die "there is no indurop-agent next to indurop-lab or in PATH"
  dirname "$(dirname "$(readlink -f "$found")")"
}

# Debian's packages of the libraries that the programs and the module of field devices load.
libraries() {
  for program in "$1"/bin/indurop "$1"/bin/indurop-* "$1"/bin/glb2idl "$1"/lib/libiodispat.so "$1"/lib/*/libiodispat.so; do ldd "$program" 2>/dev/null || true; done |
    awk '$3 ~ /^\// && !/libindurop/ {print $3}' | sort -u | while read -r file; do
    file=$(readlink -f "$file")
    # The folder /lib is a link to /usr/lib; dpkg may know a file by either.
    { dpkg -S "$file" || dpkg -S "${file#/usr}"; } 2>/dev/null | sed 's/[:,].*//;q'
  done | sort -u
}

# The image for these programs; it is made if there is none. Its folder holds disk, vmlinuz, initrd and key.
image() {
  from=$1
  wanted="$packages $(libraries "$from" | tr '\n' ' ')"
  installed=
  # Programs that a package brought into /usr cannot be lent to a machine that has its own /usr: they are copied.
  if [ "$from" = /usr ] && [ "$bare" = no ]; then installed=$(dpkg-query -W -f '${Version}' indurop 2>/dev/null) || die "which package brought $from/bin/indurop-agent? Install InduRoP's, or use another prefix"; fi
  name=$({ echo "$wanted $installed"; cat "$parts"/guest/*; } | sha256sum | cut -c1-12)
  folder=$images/$name
  if [ ! -d "$folder" ]; then make_image "$folder"; fi
}

make_image() {
  need mmdebstrap mke2fs ssh-keygen
  echo "making the image of the lab's virtual machines with mmdebstrap, some minutes, once: $1" >&2
  mkdir -p "$images"
  part=$(mktemp -d "$images/part.XXXXXX")
  trap 'rm -rf "$part"' EXIT
  ssh-keygen -q -t ed25519 -N '' -C indurop-lab -f "$part/key"
  # shellcheck disable=SC2016,SC2086 # $1 is mmdebstrap's; a list of words
  if ! mmdebstrap --variant=minbase --aptopt='APT::Install-Recommends "0"' --dpkgopt='path-exclude=/usr/share/doc/*' \
    --dpkgopt='path-exclude=/usr/share/man/*' --dpkgopt='path-exclude=/usr/share/locale/*' \
    --include="$(echo $wanted | tr ' ' ,)" \
    --setup-hook='mkdir -p "$1"/etc/initramfs-tools/conf.d "$1"/etc/initramfs-tools/hooks' \
    --setup-hook='echo MODULES=list >"$1"/etc/initramfs-tools/conf.d/lab' \
    --setup-hook="install -m 755 '$parts/guest/drivers' \"\$1\"/etc/initramfs-tools/hooks/lab" \
    bookworm "$part/root" >"$part/log" 2>&1; then
    tail -n 20 "$part/log" >&2
    die "mmdebstrap could not make the image; it fetches Debian's packages, is there a network?"
  fi
  prepare "$part/root" "$part/key.pub"
  if [ -n "$installed" ]; then dpkg -L indurop | tar -C / --no-recursion -cT - 2>/dev/null | tar -C "$part/root" -x; fi
  cp "$part"/root/boot/vmlinuz-* "$part/vmlinuz"
  cp "$part"/root/boot/initrd.img-* "$part/initrd"
  rm -rf "$part"/root/boot/* "$part"/root/var/cache/apt/*
  truncate -s 2G "$part/disk"
  mke2fs -q -F -t ext4 -d "$part/root" "$part/disk"
  rm -rf "$part/root" "$part/log"
  chmod 700 "$part"
  mv -T "$part" "$1"
  trap - EXIT
}

prepare() {
  mkdir -p "$1/etc/lab" "$1/root/.ssh"
  cp "$parts/guest/board" "$parts/guest/door" "$1/etc/lab/"
  chmod 755 "$1/etc/lab/board" "$1/etc/lab/door"
  cp "$2" "$1/root/.ssh/authorized_keys"
  chmod -R go= "$1/root/.ssh"
  for unit in lab-board lab-door; do
    cp "$parts/guest/$unit.service" "$1/etc/systemd/system/"
    mkdir -p "$1/etc/systemd/system/multi-user.target.wants"
    ln -s "/etc/systemd/system/$unit.service" "$1/etc/systemd/system/multi-user.target.wants/"
  done
  # No program of a lab's board listens on its own, or waits for what a lab has not.
  for unit in ssh.service ssh.socket systemd-timesyncd.service apt-daily.timer apt-daily-upgrade.timer e2scrub_reap.service; do
    ln -sf /dev/null "$1/etc/systemd/system/$unit"
  done
  echo '/dev/vda / ext4 rw,relatime 0 1' >"$1/etc/fstab"
  # The first start must not ask anything, nor take another machine's name.
  : >"$1/etc/machine-id"
  echo board >"$1/etc/hostname"
}

# add_machine BOARD NUMBER: off, its cable in the switch.
add_machine() {
  ip -n "$switch" tuntap add "port$2" mode tap
  ip -n "$switch" link set "port$2" master switch up
  mkdir -p "$machines/$1"
  cp --sparse=always --reflink=auto "$folder/disk" "$machines/$1/disk"
  echo "$2" >"$machines/$1/number"
  echo "$folder" >"$machines/$1/image"
  if [ "$bare" = yes ] || [ "$from" = /usr ]; then : >"$machines/$1/programs"; else echo "$from" >"$machines/$1/programs"; fi
  echo "$cores $counted" >"$machines/$1/processor"
}

processor() {
  # shellcheck disable=SC2046 # two words
  set -- $(fact "$1" processor)
  if [ "$2" = yes ]; then
    echo "-accel tcg,tb-size=128 -cpu max -smp 1 -icount shift=0,sleep=off -rtc base=2026-01-01,clock=vm"
  elif has_kvm; then
    echo "-accel kvm -cpu host -smp $1"
  else
    echo "-accel tcg,tb-size=128 -cpu max -smp $1"
  fi
}

# On a busy host a machine without KVM is slow: its kernel waits too short for the first ticks (no_timer_check), and systemd
# for services.
power_on() {
  number=$(fact "$1" number)
  folder=$(fact "$1" image)
  lent=$(fact "$1" programs)
  # shellcheck disable=SC2046 # lists of words
  ip netns exec "$switch" qemu-system-x86_64 -name "$switch.$1" -M q35 $(processor "$1") -m 640 -display none -device i6300esb \
    -daemonize -pidfile "$machines/$1/pid" \
    -chardev "socket,id=console,path=$machines/$1/console,server=on,wait=off,logfile=$machines/$1/log" -serial chardev:console \
    -drive "if=virtio,format=raw,file=$machines/$1/disk" \
    -netdev "tap,id=board,ifname=port$number,script=no,downscript=no" \
    -device "virtio-net-pci,netdev=board,romfile=,mac=52:54:00:77:00:$(printf %02x "$number"),addr=10" \
    -netdev "user,id=door,restrict=on,hostfwd=tcp:127.0.0.1:$((door_ports + number))-:22" \
    -device "virtio-net-pci,netdev=door,romfile=,mac=52:54:00:78:00:$(printf %02x "$number"),addr=11" \
    $([ -z "$lent" ] || echo "-virtfs local,path=$lent,mount_tag=programs,security_model=none,readonly=on") \
    -kernel "$folder/vmlinuz" -initrd "$folder/initrd" -append "root=/dev/vda rw console=ttyS0 quiet panic=-1 mitigations=off no_timer_check \
systemd.default_timeout_start_sec=1h systemd.service_watchdogs=0 net.ifnames=0 lab.board=$1 lab.address=10.77.0.$number lab.programs=$lent" ||
    die "qemu could not start board $1"
}

# Not a shutdown: what is not on the disk yet is lost.
power_off() {
  if is_on "$1"; then kill -9 "$(cat "$machines/$1/pid")"; fi
  rm -f "$machines/$1/pid"
}

remove_machine() {
  power_off "$1"
  ip -n "$switch" link delete "port$(fact "$1" number)" 2>/dev/null || true
  rm -rf "${machines:?}/$1"
}

# into BOARD SSH-WORDS...: through its door. -q: the door's key is new with every image, which ssh would tell each time.
# The patience, in seconds, is for the exchange of keys as well, which takes long without KVM on a busy machine.
# A machine that was reset meanwhile knows nothing of the connection: after three minutes without an answer, ssh ends.
patience=60
into() {
  name=$1
  shift
  ip netns exec "$switch" ssh -q -i "$(fact "$name" image)/key" -p $((door_ports + $(fact "$name" number))) -o BatchMode=yes \
    -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null -o ConnectTimeout=$patience \
    -o ServerAliveInterval=20 -o ServerAliveCountMax=9 -l root 127.0.0.1 "$@"
}

wait_for_machine() {
  tries=0
  until (patience=5 && into "$1" true); do
    tries=$((tries + 1))
    if ! is_on "$1" || [ $tries -ge 300 ]; then
      tail -n 15 "$machines/$1/log" >&2
      die "board $1 does not answer; above is what its console said last"
    fi
    sleep 1
  done
}

quoted() { for word in "$@"; do printf " '%s'" "$(printf %s "$word" | sed "s/'/'\\\\''/g")"; done; }

# A terminal where there is one; nothing is read from it by a job in the background, which would be stopped.
exec_machine() {
  board=$1
  shift
  is_on "$board" || die "board $board has no power; indurop-lab on $board"
  stdin=
  if [ -t 0 ]; then
    read -r _ _ _ _ group _ _ foreground _ <"/proc/$$/stat"
    if [ "$group" = "$foreground" ] && [ -t 1 ]; then stdin=-t; else stdin=-n; fi
  fi
  # shellcheck disable=SC2086 # nothing, or one word
  into "$board" $stdin "cd$(quoted "$PWD") 2>/dev/null; exec$(quoted "$@")"
}
