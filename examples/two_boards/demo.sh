#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A control loop between two boards, both on this host: values on both, a board that dies and comes back.
# Needs the programs in PATH; `make demo` and `indurop demo` see to it.
set -e
here=$(cd "$(dirname "$0")" && pwd)
folder=${INDUROP_DEMO_DIR:-$here/../../build/examples/two_boards}
cd "$folder"

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
show() { say "\$ $*"; "$@"; }
cleanup() {
  for pid in $again $runner; do kill "$pid" 2>/dev/null || true; done
  for pid in $again $runner; do wait "$pid" 2>/dev/null || true; done
  for board in sensor control; do indurop clean --node $board >/dev/null 2>&1 || true; done
}
again=
runner=
trap cleanup EXIT
trap 'exit 130' INT TERM

for board in sensor control; do indurop clean --node $board >/dev/null 2>&1 || true; done
say "Two boards: the sensor board measures a turning table, the control board keeps its speed"
show indurop check plant.xml
say "\$ indurop run plant.xml --local &"
indurop run plant.xml --local -q &
runner=$!
tries=0
until [ "$(indurop get --node sensor echo 2>/dev/null || echo 0)" -gt 0 ]; do
  tries=$((tries + 1))
  [ $tries -lt 100 ] || { echo "the boards do not hear each other"; exit 1; }
  sleep 0.1
done
show indurop watch --node sensor encoder torque lag -n 2
show indurop set --node control target 5
sleep 1
show indurop get --node sensor encoder torque
show indurop status --node sensor
say "The control board dies (kill -9): without it the motor gets the declared fallback, no torque"
victim=$(indurop nodes -o csv | awk -F, '$1 == "control" { print $3 }')
[ "$victim" -gt 1 ] || exit 1
echo "\$ kill -9 $victim"; kill -9 "$victim"
sleep 1.5
show indurop get --node sensor torque
show indurop status --node sensor
say "It comes back, and the loop closes again"
say "\$ indurop run plant.xml --board control --one-host &"
indurop run plant.xml --board control --one-host -q --duration 4s &
again=$!
sleep 2.5
show indurop watch --node sensor encoder torque -n 2
