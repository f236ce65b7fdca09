#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_packages.sh DEBS WORK: what users do with the packages, in a new Debian 12 without a compiler: install, demo (as root and
# as a user without rights), install again, remove while a node runs, purge. Needs root, mmdebstrap and a Debian mirror.
# INDUROP_PROOF_ROOT: a tar file of such a Debian, which else is made.
# shellcheck disable=SC2016 # texts in single quotes are for shells inside
set -eu
debs=$(cd "$1" && pwd)
mkdir -p "$2"
work=$(cd "$2" && pwd)
root=$work/root
. "$(dirname "$0")/checks.sh"

# The machine's own network, devices and kernel settings are out of reach; its processes are, too.
inside() {
  unshare --mount --pid --fork --mount-proc="$root/proc" ${network:+--net} sh -c '
    root=$1; shift
    mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
    mount --bind /dev/null "$root/dev/null" 2>/dev/null || true
    ip link set lo up 2>/dev/null || true
    exec chroot "$root" "$@"' sh "$root" "$@"
}
files() { (cd "$root" && find . -xdev \( -path ./proc -o -path ./dev -o -path ./sys -o -path ./tmp -o -path ./run -o -path ./root -o -path ./debs \) -prune -o -print | LC_ALL=C sort); }

rm -rf "$root"
mkdir -p "$root"
if [ -n "${INDUROP_PROOF_ROOT:-}" ]; then
  tar -x -C "$root" -f "$INDUROP_PROOF_ROOT"
else
  mmdebstrap --quiet --variant=minbase bookworm "$root"
fi
mkdir -p "$root/dev/shm" "$root/debs"
cp "$debs"/*.deb "$root/debs"
cp /etc/resolv.conf "$root/etc/resolv.conf"
# A service of the installed Debian starts nothing here; the kernel stays the machine's own.
printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d"
chmod +x "$root/usr/sbin/policy-rc.d"
check "no compiler is there" sh -c '! chroot "$0" sh -c "command -v cc || command -v g++ || command -v cmake"' "$root"
# What others' packages leave is not ours: they are installed before the first list of files is made.
libraries=$(for deb in "$debs"/indurop_*.deb "$debs"/indurop-examples_*.deb; do dpkg-deb -f "$deb" Depends; done | tr ',' '\n' |
  sed 's/[|(].*//;s/ //g' | grep -v '^indurop' | sort -u | tr '\n' ' ')
# shellcheck disable=SC2086 # a list of words
inside sh -c "apt-get -qq update && DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $libraries passwd >/dev/null"
files >"$work/before"

started=$(date +%s)
inside sh -c 'DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends /debs/indurop_*.deb /debs/indurop-examples_*.deb' >"$work/install.log" 2>&1
installed=$(date +%s)
network=none
for user in 0 65534; do
  check "the arm moves on the page, for user $user" inside setpriv --reuid=$user --regid=$user --clear-groups sh -c '
    export HOME=/tmp
    indurop demo >/tmp/demo.$$ 2>&1 & demo=$!
    tries=0
    until grep -q "http://" /tmp/demo.$$; do tries=$((tries + 1)); [ $tries -lt 600 ] || { cat /tmp/demo.$$; exit 1; }; sleep 0.1; done
    node=$(indurop nodes -o csv | grep -o "^demo[0-9]*")
    first=$(indurop get --node "$node" ROBOT_ARM.joint)
    tries=0
    until [ "$(indurop get --node "$node" ROBOT_ARM.joint)" != "$first" ]; do
      tries=$((tries + 1)); [ $tries -lt 600 ] || { echo "it stands"; cat /tmp/demo.$$; exit 1; }; sleep 0.1
    done
    kill $demo; wait $demo; [ $? = 143 ] || { echo "another end"; exit 1; }
    left=$(ls -d /dev/shm/indurop.* /tmp/indurop-* 2>/dev/null || true)
    [ -z "$left" ] || { echo "left: $left"; exit 1; }
    rm /tmp/demo.$$'
  [ $user = 0 ] && echo "      installed after $((installed - started)) s, the arm moved and the demo was ended after $(($(date +%s) - started)) s"
done
check "user, group and folders are there" inside sh -c 'id indurop && [ "$(stat -c %U:%a /var/lib/indurop)" = indurop:750 ] && [ -d /etc/indurop ]'
check "installing again changes nothing" inside sh -c 'dpkg -i /debs/indurop_*.deb /debs/indurop-examples_*.deb && dpkg --audit && id indurop'

# The next release: the same files under a higher number.
next=$work/next
rm -rf "$next"
dpkg-deb -R "$debs"/indurop_*.deb "$next"
sed -i 's/^Version: .*/&+next/' "$next/DEBIAN/control"
dpkg-deb -Zgzip -z1 -b "$next" "$root/debs/next.deb" >/dev/null
rm -rf "$next"
check "an upgrade while a node runs says so, and the node goes on" inside sh -c '
  cd /usr/lib/*/indurop/examples/chapter && INDUROP_STATE_DIR=/tmp/state indurop run module.xml --detach --node up && cd / &&
  dpkg --force-depends -i /debs/next.deb >/tmp/up.log 2>&1; cat /tmp/up.log
  grep -q "go on with version" /tmp/up.log && indurop get --node up knu::Robot::tick && indurop stop --node up
  dpkg -i /debs/indurop_*.deb'
check "an upgrade that is killed at any moment is completed by the next one, and the node goes on" inside sh -c '
  cd /usr/lib/*/indurop/examples/chapter && INDUROP_STATE_DIR=/tmp/state indurop run module.xml --detach --node cut && cd / || exit 1
  for after in 0.02 0.05 0.1 0.15 0.2 0.3 0.4 0.5 0.7 1; do
    timeout -s KILL $after dpkg --force-depends -i /debs/next.deb >/dev/null 2>&1
    timeout -s KILL $after dpkg -i /debs/indurop_*.deb >/dev/null 2>&1
    indurop get --node cut knu::Robot::tick >/dev/null 2>&1 || cut=1
  done
  [ -z "$cut" ] || echo "while files were replaced, indurop was not there at least once"
  dpkg --configure -a && dpkg -i /debs/indurop_*.deb && [ -z "$(dpkg --audit)$(dpkg -V indurop)" ] &&
    first=$(indurop get --node cut knu::Robot::tick) && sleep 0.1 && [ "$(indurop get --node cut knu::Robot::tick)" != "$first" ] &&
    indurop stop --node cut'
check "a package removed while a node runs says so, and the node goes on" inside sh -c '
  cd /usr/lib/*/indurop/examples/chapter && INDUROP_STATE_DIR=/tmp/state indurop run module.xml --detach --node gone && cd /
  node=$(pgrep -f "indurop-node.*gone" 2>/dev/null || for p in /proc/[0-9]*; do case $(readlink $p/exe) in /usr/bin/indurop-node*) echo ${p#/proc/};; esac; done)
  dpkg -r indurop-examples indurop >/tmp/gone.log 2>&1; cat /tmp/gone.log
  grep -q "go on without their files" /tmp/gone.log && for p in $node; do kill -0 $p && kill $p; done'
check "installed again, then purged, nothing is left" inside sh -c 'dpkg -i /debs/indurop_*.deb /debs/indurop-examples_*.deb && dpkg -P indurop-examples indurop && ! getent passwd indurop && ! getent group indurop'
files >"$work/after"
network=
if command -v apt-ftparchive >/dev/null && command -v gpg >/dev/null; then
  INDUROP_APT_KEYS=$work/keys "$(dirname "$0")/../../../cmake/packaging/make_apt.sh" "$root/debs/apt" "$debs" >/dev/null 2>&1
  use='install -D -m 644 /debs/apt/indurop.asc /etc/apt/keyrings/indurop.asc
    sed "s,^URIs:.*,URIs: file:/debs/apt," /debs/apt/indurop.sources >/etc/apt/sources.list.d/indurop.sources
    only="-o Dir::Etc::sourcelist=/dev/null -o APT::Get::List-Cleanup=0 -o APT::Update::Error-Mode=any"
    apt-get -qq update $only'
  check "apt installs from the signed repository" inside sh -c "set -e; $use; DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends indurop indurop-examples
    apt-cache policy indurop | grep -q file:/debs/apt"
  for deb in "$root"/debs/apt/indurop-examples_*.deb; do printf x >>"$deb"; done
  check "apt refuses a package that was changed" inside sh -c "! apt-get -qq install -y --reinstall indurop-examples"
  sed -i 's/^Label: .*/Label: another/' "$root/debs/apt/InRelease"
  check "apt refuses a repository that was changed" inside sh -c "if $use; then exit 1; fi"
fi
check "no file is left by purge" diff "$work/before" "$work/after"
PATH=$PATH:/usr/sbin
if command -v piuparts >/dev/null; then
  mmdebstrap --quiet --variant=minbase bookworm "$work/base.tar.gz"
  # What systemd makes when it is installed is not ours.
  check "piuparts finds nothing" piuparts -d bookworm -b "$work/base.tar.gz" --skip-logrotatefiles-test --warn-on-debsums-errors \
    -I '^/(root/.ssh|var/(cache|lib|log)/private|var/lib/systemd/.*)' "$debs"/indurop_*.deb "$debs"/indurop-examples_*.deb
fi
echo "$failures wrong"
exit $((failures > 0))
