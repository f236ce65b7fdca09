#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The arm of the robot cell on an EtherCAT bus: two terminals and six drives, simulated at the other end of a cable
# without hardware. A tour of twenty seconds, then a drive without power. With "plant", the PLC program is on a board of
# its own. Needs the programs in PATH, and root or the rights to make a network interface and to use raw sockets.
set -e
here=$(cd "$(dirname "$0")" && pwd)
folder=${INDUROP_DEMO_DIR:-$here/../../build/examples/ethercat_arm}
cd "$folder"
node=${INDUROP_DEMO_NODE:-arm}
[ "$1" != plant ] || node=arm_bus
runner=
slaves=

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
show() { say "\$ $*"; "$@"; }
cleanup() {
  for pid in $runner $slaves; do kill "$pid" 2>/dev/null || true; done
  for pid in $runner $slaves; do wait "$pid" 2>/dev/null || true; done
  ip link delete ecarm0 2>/dev/null || true
  rm -f bus.fifo
  for name in $node arm_ladder; do indurop clean --node $name >/dev/null 2>&1 || true; done
}
value() { indurop get --node $node "$1" 2>/dev/null; }
show_state() { indurop get --node $node 'CELL::*' ROBOT_JOB ROBOT_MODULE_STATE EMERGENCY_STOP 'BUS::*' I0 I1 I3 I4 I5 I6 O0 O1 O8 O9; }
# wait_for VARIABLE VALUE SECONDS
wait_for() {
  tries=0
  until [ "$(value "$1")" = "$2" ]; do
    tries=$((tries + 1))
    kill -0 "$runner" 2>/dev/null || { echo "the node has ended: its messages are above"; exit 1; }
    [ $tries -lt $(($3 * 10)) ] || { echo "$1 is $(value "$1"), it did not become $2"; show_state; exit 1; }
    sleep 0.1
  done
}
press() {
  indurop set --node $node -q "CELL::panel.$1" true
  sleep 0.3
  indurop set --node $node -q "CELL::panel.$1" false
}
fault() { echo "0s $*" >bus.fifo; }

if ! ip link add ecarm0 type veth peer name ecarm1; then
  echo "The bus needs a network interface of its own, and this user may not make one: run it as root, or with"
  echo "CAP_NET_ADMIN and CAP_NET_RAW; in a container: --cap-add NET_ADMIN --cap-add NET_RAW"
  exit 1
fi
trap cleanup EXIT  # not before: the interface and the pipe may be those of another demo
trap 'exit 130' INT TERM HUP
ip link set ecarm0 up
ip link set ecarm1 up

say "Six drives and two terminals at the end of a cable; the terminals are those of a maker's file (ESI)"
rm -f bus.fifo
mkfifo bus.fifo
# Slaves answer at once, whatever else the machine does.
urgent=$(chrt -f 40 true 2>/dev/null && echo "chrt -f 40" || true)
$urgent indurop-ecsim ecarm1 terminals.xml:SAMPLE-DI16 terminals.xml:SAMPLE-DO16 \
  drive:start=0,speed=220,following=20 drive:start=-20,speed=220,following=20 drive:start=10,speed=220,following=20 \
  drive:start=0,speed=440,following=20 drive:start=100,speed=440,following=20 drive:start=0,speed=540,following=20 \
  --script - <>bus.fifo &
slaves=$!
say "\$ indurop io scan ecarm0"
indurop io scan ecarm0 | sed '/^$/,$d'
if [ "$1" = plant ]; then
  say "\$ indurop check plant.xml"
  indurop check plant.xml -q | tail -n 1
  say "\$ indurop run plant.xml --local &"
  indurop run plant.xml --local -q &
else
  say "\$ indurop check module.xml"
  indurop check module.xml -q | tail -n 1
  say "\$ indurop run module.xml --node $node &"
  indurop run module.xml --node $node -q &
fi
runner=$!
wait_for I14 1 20
wait_for EMERGENCY_STOP.bActive 0 10

if [ "$1" = plant ]; then
  say "A visitor starts the cell; the ladder program on the other board sees to it that a part is placed"
  indurop set --node $node -q CELL::tour true
  wait_for CELL::world.placed 1 30
else
  say "A visitor starts the cell, walks through the light curtain and hits the emergency stop; its job goes on after that"
  indurop set --node $node -q CELL::tour true
  # A line every two seconds, and one whenever the visitor does something else.
  begin=$(date +%s)
  next=2
  shown='""'
  while second=$(($(date +%s) - begin)) && [ $second -le 20 ]; do
    doing=$(value CELL::world.doing)
    if [ $second -ge $next ] || [ "$doing" != "$shown" ]; then
      printf '%3d s  job %-6s %-22s %s on the pallet, visitor %s\n' $second "$(value ROBOT_JOB.name)" \
        "$(value ROBOT_MODULE_STATE.eState)" "$(value CELL::world.placed)" "$doing"
      next=$((second / 2 * 2 + 2))
      shown=$doing
    fi
    sleep 0.1
  done
fi
wait_for ROBOT_MODULE_STATE.eState ROBOT_GROUP_MOVING 10

say "Drive 3 loses its power for two seconds, and with it the cable to those after it: everything stops"
fault power_off slave=4 for=2s
wait_for EMERGENCY_STOP.bActive 1 2
wait_for ROBOT_MODULE_STATE.eState ROBOT_GROUP_ERRORSTOP 5
show indurop get --node $node BUS::quality BUS::state.bLost ROBOT_MODULE_STATE.eState
wait_for BUS::state.bLost 0 10
say "It is back, with everything set again; the job goes on after reset and start"
placed=$(value CELL::world.placed)
press reset
sleep 0.7
press start
wait_for ROBOT_MODULE_STATE.eState ROBOT_GROUP_MOVING 10
wait_for CELL::world.placed $((placed + 1)) 30
wait_for CELL::world.lost 0 1
show indurop get --node $node CELL::world.placed CELL::world.lost ROBOT_MODULE_STATE.eState
show indurop jitter --node $node --no-histogram

# A user may go on with faults of their own.
if [ -t 0 ] && [ -t 1 ]; then
  say "The arm goes on. Type faults (indurop-ecsim --help lists them), Ctrl-D ends it: power_off slave=4 for=2s"
  while read -r line; do fault "$line"; done
fi
if [ "$1" = plant ]; then kill $runner; else indurop stop --node $node >/dev/null; fi
wait $runner || true
runner=
