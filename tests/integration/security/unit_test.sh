#!/bin/sh
# The services: what systemd finds wrong with them, and that a board has the two rights it needs and no others.
# Usage: unit_test.sh SOURCE_DIR PROGRAM_DIR
set -eu
unit=$1/cmake/packaging/systemd/indurop-agent@.service.in
fail() { echo "$unit: $1" >&2; exit 1; }

for key in CapabilityBoundingSet AmbientCapabilities; do
  grep -qx "$key=CAP_SYS_NICE CAP_IPC_LOCK" "$unit" || fail "$key is not what a node needs"
done
for line in NoNewPrivileges=yes ProtectSystem=strict ProtectHome=yes User=indurop LimitMEMLOCK=infinity; do
  grep -qx "$line" "$unit" || fail "$line is missing"
done
# Without it a node cannot tell whether its clock is kept by others.
grep -Eq '^SystemCallFilter=.*clock_adjtime' "$unit" || fail "a node reads the state of the clock"
if grep -Eq '^(RestrictRealtime|PrivateDevices|ProtectClock|DynamicUser|MemoryDenyWriteExecute)=(yes|true)' "$unit"; then
  fail "real-time threads, hardware or shared memory would not work"
fi

command -v systemd-analyze >/dev/null || { echo "skipped: no systemd-analyze"; exit 0; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for unit in "$1"/cmake/packaging/systemd/*.service.in; do
  name=$(basename "$unit" .in)
  sed -e "s|@INDUROP_PROGRAMS@|$2|" -e "s|@INDUROP_DOCS@|$1/docs|" "$unit" >"$work/$name"
  said=$(systemd-analyze verify "$work/$name" 2>&1 | grep -F "$work" || true)
  [ -z "$said" ] || fail "$said"
done

# Those that only speak over the network and need no right at all.
for name in serve mqtt opcua; do
  said=$(systemd-analyze security --offline=true --threshold=40 "$work/indurop-$name.service" 2>&1) ||
    fail "can do too much: $(echo "$said" | tail -n 2)"
done
