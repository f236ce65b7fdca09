#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Thirty-three simulated drives on an EtherCAT bus, each moved every millisecond, for a minute (demo.sh SECONDS). Needs
# the programs in PATH, and root or the rights to make a network interface and to use raw sockets.
set -e
here=$(cd "$(dirname "$0")" && pwd)
folder=${INDUROP_DEMO_DIR:-$here/../../build/examples/ethercat_33}
cd "$folder"
node=${INDUROP_DEMO_NODE:-axes33}
seconds=${1:-60}
runner=
slaves=

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
cleanup() {
  for pid in $runner $slaves; do kill "$pid" 2>/dev/null || true; done
  for pid in $runner $slaves; do wait "$pid" 2>/dev/null || true; done
  ip link delete ec33a 2>/dev/null || true
  indurop clean --node $node >/dev/null 2>&1 || true
}
trap cleanup EXIT
trap 'exit 130' INT TERM HUP
value() { indurop get --node $node "$1" 2>/dev/null; }

if ! ip link add ec33a type veth peer name ec33b; then
  echo "The bus needs a network interface of its own, and this user may not make one: run it as root, or with"
  echo "CAP_NET_ADMIN and CAP_NET_RAW; in a container: --cap-add NET_ADMIN --cap-add NET_RAW"
  exit 1
fi
ip link set ec33a up
ip link set ec33b up

say "Thirty-three drives at the end of a cable"
drives=
for axis in $(seq 33); do drives="$drives drive"; done
# Slaves answer at once, whatever else the machine does.
urgent=$(chrt -f 40 true 2>/dev/null && echo "chrt -f 40" || true)
$urgent indurop-ecsim ec33b $drives &
slaves=$!
say "\$ indurop run module.xml --node $node &"
indurop run module.xml --node $node -q &
runner=$!
tries=0
until [ "$(value AXES::state.enabled)" = 33 ]; do
  tries=$((tries + 1))
  kill -0 "$runner" 2>/dev/null || { echo "the node has ended: its messages are above"; exit 1; }
  [ $tries -lt 300 ] || { echo "$(value AXES::state.enabled) of 33 axes are enabled"; exit 1; }
  sleep 0.1
done
say "All axes move; $seconds s of it"
before=$(value AXES::errors | tr -dc '0-9,\n' | tr ',' '\n' | sort -n | tail -n 1)
sleep "$seconds"
after=$(value AXES::errors | tr -dc '0-9,\n' | tr ',' '\n' | sort -n | tail -n 1)
echo "enabled $(value AXES::state.enabled) axes, largest deviation $(value AXES::state.deviation) deg," \
  "exchanges without data of the worst axis: $((after - before)) of $((seconds * 1000))"
indurop jitter --node $node --no-histogram
indurop stop --node $node >/dev/null
wait $runner || true
runner=
