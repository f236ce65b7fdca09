#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The robot cell at work with all doors to other tools open at once: HTTP and the page, /metrics, MQTT with Sparkplug B,
# OPC UA, Python, C, DDS, a recording, FMI. Each shows the same joint; at the end, what they cost the tick. Takes half a
# minute; `doors.sh stay` leaves everything open until Ctrl-C. Needs the programs in PATH; what is not installed is named.
set -e
here=$(cd "$(dirname "$0")" && pwd)
folder=$here
[ -e "$folder/Robot.so" ] || folder=${INDUROP_DEMO_DIR:-$here/../../build/examples/robot_cell}
cd "$folder"

node=doors$$
joint='ROBOT_ARM.joint[0]'
work=$(mktemp -d)
children=

for program in indurop python3; do
  command -v $program >/dev/null || { echo "$program is not in PATH" >&2; exit 1; }
done

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
door() { printf '%-22s %s\n' "$1" "$2"; }
has() { command -v "$1" >/dev/null 2>&1; }
cleanup() {
  for pid in $children; do kill "$pid" 2>/dev/null || true; done
  for pid in $children; do wait "$pid" 2>/dev/null || true; done
  indurop clean --node $node >/dev/null 2>&1 || true
  rm -rf "$work"
}
trap cleanup EXIT
trap 'exit 130' INT TERM HUP

# in_background NAME COMMAND...: its output goes to $work/NAME.log
in_background() {
  file=$work/$1.log
  shift
  "$@" >"$file" 2>&1 &
  children="$! $children"
}

# wait_until FILE PATTERN: prints the first match; what the program said if there is none
wait_until() {
  tries=0
  until found=$(grep -m 1 -o "$2" "$work/$1.log" 2>/dev/null); do
    tries=$((tries + 1))
    [ $tries -lt 300 ] || { cat "$work/$1.log" >&2; echo "$1 is not ready" >&2; exit 1; }
    sleep 0.1
  done
  echo "$found"
}

# wait_for VARIABLE VALUE
wait_for() {
  tries=0
  until [ "$(indurop get --node $node "$1" 2>/dev/null)" = "$2" ]; do
    tries=$((tries + 1))
    [ $tries -lt 300 ] || { cat "$work/cell.log" >&2; echo "$1 did not become $2" >&2; exit 1; }
    sleep 0.1
  done
}

tick() { indurop status --node $node | sed -n 's/^  lateness/tick:/p; s/.*\(tick [0-9]*, .*lost tick.*\)/\1/p'; }

in_background cell indurop run module.xml --node $node -q
wait_for I14 1
wait_for EMERGENCY_STOP.bActive 0
indurop set --node $node CELL::tour true
say "The cell works"
sleep 5
tick

say "All doors are opened; each shows the first joint of the arm, in degrees"
in_background serve indurop serve --node $node --port 0 --metrics ROBOT_ARM
http=$(wait_until serve 'http://[^ /]*')
door 'page' "$http/"
ask() { python3 -c 'import sys, urllib.request; sys.stdout.write(urllib.request.urlopen(sys.argv[1], timeout=10).read().decode())' "$1"; }
door 'HTTP' "$(ask "$http/api/v1/boards/$node/variables?match=ROBOT_ARM.joint%5B0%5D" | grep -o '"text":"[^"]*"')"
door '/metrics' "$(ask "$http/metrics" | grep -F -m 1 "$joint")"

if python3 -c 'import indurop' 2>/dev/null; then
  door 'Python' "$(python3 -c 'import indurop, sys
changes = indurop.node(sys.argv[1]).variable(sys.argv[2]).watch()
print([round(next(changes), 2) for _ in range(3)])' $node "$joint")"
else
  door 'Python' 'the package python3-indurop is not installed'
fi

broker=$(PATH="$PATH:/usr/sbin" command -v mosquitto || true)
if [ -n "$broker" ] && has mosquitto_sub && has indurop-mqtt; then
  port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
  printf 'listener %s 127.0.0.1\nallow_anonymous true\npersistence false\n' "$port" >"$work/broker.conf"
  in_background broker "$broker" -c "$work/broker.conf"
  wait_until broker running >/dev/null
  in_background mqtt indurop-mqtt --serve "$http" --broker "mqtt://127.0.0.1:$port" --variables "$joint" --sparkplug cell --state "$work/mqtt"
  door 'MQTT' "$(mosquitto_sub -p "$port" -W 20 -C 1 -t "indurop/$node/values/#" -F '%t %p' | cut -c -90)..."
  door 'Sparkplug B' "$(mosquitto_sub -p "$port" -W 20 -C 1 -t 'spBv1.0/cell/DDATA/#' -F '%t, %l bytes')"
else
  door 'MQTT' 'mosquitto, mosquitto-clients or indurop-mqtt is not installed'
fi

if has indurop-opcua && has node; then
  in_background opcua indurop-opcua --serve "$http" --port 0 --anonymous --state "$work/opcua"
  door 'OPC UA' "$(wait_until opcua 'opc.tcp://[^ ]*')  ns=2;s=$node/$joint"
else
  door 'OPC UA' 'nodejs or indurop-opcua is not installed'
fi

indurop record --node $node -o "$work/cell.mcap" --duration 3s -q ROBOT_ARM
door 'recording (MCAP)' "$(indurop recording info "$work/cell.mcap" | sed "s|$work/||; q")"
if has indurop-fmu; then
  door 'FMI' "$(indurop-fmu module.xml -o "$work/cell.fmu" | sed "s|$work/||")"
else
  door 'FMI' 'the package indurop-fmu is not installed'
fi

say "With all of them open"
sleep 5
tick
[ "$1" = stay ] || exit 0
say "Ctrl-C ends it"
while kill -0 "${children##* }" 2>/dev/null; do sleep 1; done
