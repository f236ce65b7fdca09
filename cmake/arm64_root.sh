#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# arm64_root.sh [COMMAND...]: runs COMMAND in a Debian of amd64 that cross-compiles for arm64, in the folder in which it was called.
# That Debian lies in build-arm64-root/ and is made once; no package of this machine is changed. Needs root, mmdebstrap and, the
# first time and when packages are added, a Debian mirror. A session has mounts of its own, which end with it.
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
root=$top/build-arm64-root
# Tools are those of amd64. What is linked comes from the packages' control file, for arm64.
tools="crossbuild-essential-arm64 cmake ninja-build ccache python3 debhelper rsync fakeroot lintian qemu-user qemu-system-arm cpio"
kernel=linux-image-6.12-rt-arm64 # names the newest one
boost="libboost-filesystem-dev:arm64 libboost-serialization-dev:arm64 libboost-system-dev:arm64" # libompl-dev names their files
tested="libgtest-dev:arm64 libgmock-dev:arm64 liborocos-kdl-dev:arm64 libompl-dev:arm64 $boost busybox-static:arm64"
control=$top/cmake/packaging/debian/control

die() {
  echo "arm64: $*" >&2
  exit 1
}

# enter COMMAND...: the tree is at the same place inside, so paths that compilers write down are valid in both.
enter() {
  mkdir -p "$root$top"
  # shellcheck disable=SC2016 # the text is for the shell inside
  unshare --mount --pid --fork --kill-child --mount-proc="$root/proc" sh -c '
    root=$1 top=$2 here=$3; shift 3
    mount --rbind "$top" "$root$top"
    mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
    mount --bind /dev/null "$root/dev/null" && mount --bind /dev/urandom "$root/dev/urandom"
    exec chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
      PYTHONDONTWRITEBYTECODE=1 ${JOBS:+JOBS="$JOBS"} sh -c "cd \"\$0\" && exec \"\$@\"" "$here" "$@"' sh "$root" "$top" "$(pwd)" "$@"
}

make_root() {
  command -v mmdebstrap >/dev/null || die "the command mmdebstrap is missing; apt-get install mmdebstrap"
  echo "arm64: making a Debian for cross builds in $root, some minutes, once" >&2
  rm -rf "$root.part"
  mmdebstrap --quiet --variant=minbase --architectures=amd64,arm64 --aptopt='APT::Install-Recommends "0"' \
    --dpkgopt='path-exclude=/usr/share/man/*' --dpkgopt='path-exclude=/usr/share/doc/*' \
    --include="$(echo "$tools" | tr ' ' ,)" bookworm "$root.part" >&2 ||
    die "mmdebstrap could not make it; it fetches Debian's packages, is there a network?"
  mv -T "$root.part" "$root"
}

# apt fetches only what is not there yet. The kernel is for the machine of `make arm64-test`, so it is not installed.
add_packages() {
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  # shellcheck disable=SC2016 # the text is for the shell inside
  enter sh -c 'apt-get -qq update && apt-get -qq install -y '"$tools $tested"' && apt-get -qq build-dep -y -P cross -a arm64 ./cmake/packaging &&
    cd /var/tmp && apt-get -qq download $(apt-cache depends '"$kernel"':arm64 | sed -n "s/.*Depends: //p") &&
    rm -rf /kernel && dpkg-deb -x linux-image-*.deb /kernel && rm linux-image-*.deb && apt-get clean' >"$root/var/log/added" 2>&1 </dev/null || {
    tail -n 20 "$root/var/log/added" >&2
    die "apt-get could not add the packages of arm64; above is what it said last"
  }
  echo "$wanted" >"$root/etc/indurop-packages"
}

[ "$(uname -m)" = x86_64 ] || die "this is a cross build for x86-64 machines; elsewhere make does it"
[ "$(id -u)" = 0 ] || die "needs root, for chroot and mounts of its own"
[ -d "$root" ] || make_root
wanted=$({ echo "$tools $tested $kernel"; cat "$control"; } | sha256sum)
[ "$(cat "$root/etc/indurop-packages" 2>/dev/null)" = "$wanted" ] || (cd "$top" && add_packages)
[ $# = 0 ] || enter "$@"
