#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The torque of a motor, closed over a veth pair every 100 us, for a minute (demo.sh SECONDS). Needs the programs in
# PATH, and root or the rights to make a network interface and to use raw sockets.
set -e
here=$(cd "$(dirname "$0")" && pwd)
folder=${INDUROP_DEMO_DIR:-$here/../../build/examples/ethercat_current}
cd "$folder"
node=${INDUROP_DEMO_NODE:-current}
seconds=${1:-60}
runner=
slaves=

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
cleanup() {
  for pid in $runner $slaves; do kill "$pid" 2>/dev/null || true; done
  for pid in $runner $slaves; do wait "$pid" 2>/dev/null || true; done
  ip link delete ec100a 2>/dev/null || true
  indurop clean --node $node >/dev/null 2>&1 || true
}
trap cleanup EXIT
trap 'exit 130' INT TERM HUP
value() { indurop get --node $node "$1" 2>/dev/null; }

if ! ip link add ec100a type veth peer name ec100b; then
  echo "The bus needs a network interface of its own, and this user may not make one: run it as root, or with"
  echo "CAP_NET_ADMIN and CAP_NET_RAW; in a container: --cap-add NET_ADMIN --cap-add NET_RAW"
  exit 1
fi
ip link set ec100a up
ip link set ec100b up

say "A drive at the end of a cable"
# Slaves answer at once, whatever else the machine does.
urgent=$(chrt -f 40 true 2>/dev/null && echo "chrt -f 40" || true)
$urgent indurop-ecsim ec100b "$(sed -n 's/.* slaves="\([^"]*\)".*/\1/p' ioconfig.xml)" &
slaves=$!
say "\$ indurop run module.xml --node $node &"
indurop run module.xml --node $node -q &
runner=$!
tries=0
until [ "$(value CURRENT::state.enabled)" = true ]; do
  tries=$((tries + 1))
  kill -0 "$runner" 2>/dev/null || { echo "the node has ended: its messages are above"; exit 1; }
  [ $tries -lt 300 ] || { echo "the drive is not enabled"; exit 1; }
  sleep 0.1
done
say "The torque follows a square wave; $seconds s of it"
before=$(value CURRENT::errors)
sleep "$seconds"
after=$(value CURRENT::errors)
echo "$(value CURRENT::state.steps) steps, the slowest in $(value CURRENT::state.slowest) us," \
  "the largest overshoot $(value CURRENT::state.overshoot) of 1000," \
  "exchanges without data: $((after - before)) of $((seconds * 10000))"
indurop jitter --node $node --no-histogram
indurop stop --node $node >/dev/null
wait $runner || true
runner=
