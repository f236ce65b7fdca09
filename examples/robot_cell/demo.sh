#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The robot cell (chapter, section 4) at work for twenty seconds, on one board and then on two, with no person at it.
# `demo.sh page`: only its page, until Ctrl-C. Needs the programs in PATH; `make demo` and `indurop demo` see to it.
set -e
here=$(cd "$(dirname "$0")" && pwd)
folder=${INDUROP_DEMO_DIR:-$here/../../build/examples/robot_cell}
cd "$folder"

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
show() { say "\$ $*"; "$@"; }
forget() { for node in cell plc motion $page; do indurop clean --node $node >/dev/null 2>&1 || true; done; }
cleanup() {
  for pid in $recorder $server $watchers $runner; do kill "$pid" 2>/dev/null || true; done
  for pid in $recorder $server $watchers $runner; do wait "$pid" 2>/dev/null || true; done
  forget
}
page=
recorder=
runner=
server=
watchers=
trap cleanup EXIT
trap 'exit 130' INT TERM HUP

# wait_for NODE VARIABLE VALUE
wait_for() {
  tries=0
  until [ "$(indurop get --node "$1" "$2" 2>/dev/null)" = "$3" ]; do
    tries=$((tries + 1))
    kill -0 "$runner" 2>/dev/null || { echo "node $1 has ended: its messages are above"; exit 1; }
    [ $tries -lt 100 ] || { echo "$2 of node $1 did not become $3"; exit 1; }
    sleep 0.1
  done
}

# An agent or the server of the page evaluates alarms; this demo has neither.
watch_alarms() {
  for node in "$@"; do
    wait_for "$node" EMERGENCY_STOP.bActive 0
    indurop alarms watch --node "$node" -q &
    watchers="$watchers $!"
  done
}

# tour ROBOT_NODE STATION_NODE RECORDING: twenty seconds, a line every two and whenever the visitor does something else
tour() {
  wait_for "$2" I14 1
  wait_for "$1" EMERGENCY_STOP.bActive 0
  indurop watch --node "$1" ROBOT_ARM.joint ROBOT_ARM.position ROBOT_ARM.tool_speed ROBOT_MODULE_STATE.eState ROBOT_JOB.name \
    EMERGENCY_STOP.bActive I4 I5 O8 O9 O10 --hz 50 --timeout 21s -o csv --units >"$3" &
  recorder=$!
  indurop set --node "$2" CELL::tour true
  begin=$(date +%s)
  next=2
  shown='""'
  while second=$(($(date +%s) - begin)) && [ $second -le 20 ]; do
    doing=$(indurop get --node "$2" CELL::world.doing)
    if [ $second -ge $next ] || [ "$doing" != "$shown" ]; then
      printf '%3d s  job %-6s %-22s %s on the pallet, visitor %s\n' $second \
        "$(indurop get --node "$1" ROBOT_JOB.name)" "$(indurop get --node "$1" ROBOT_MODULE_STATE.eState)" \
        "$(indurop get --node "$2" CELL::world.placed)" "$doing"
      next=$((second / 2 * 2 + 2))
      shown=$doing
    fi
    sleep 0.1
  done
  wait $recorder || true
  recorder=
}

# picture RECORDING FILE TITLE
picture() {
  for joint in 0 1 2 3 4 5; do
    set -- "$@" --name "ROBOT_ARM.joint[$joint]=J$((joint + 1))"
  done
  set -- "$@" --name 'ROBOT_ARM.tool_speed=tool speed, mm/s' --name 'ROBOT_ARM.joint=joints, deg'
  recording=$1 file=$2 title=$3
  shift 3
  indurop chart "$recording" --svg "$file" --title "$title" -q --way ROBOT_ARM.position "$@" \
    --name ROBOT_MODULE_STATE.eState=robot --name ROBOT_JOB.name=job --name EMERGENCY_STOP.bActive='emergency stop' \
    --name 'I4=I4: holds a part' --name 'I5=I5: gripper open' --name 'O8=O8: close gripper' --name 'O9=O9: open gripper' \
    --name 'O10=O10: glue'
}

# reload EXIT_CODE WORDS: another version of the ladder program, which is exchanged or not as it should be
reload() {
  expected=$1
  shift
  code=0
  show indurop reload main "$@" --node cell || code=$?
  [ $code -eq "$expected" ] || { echo "the exit code is $code instead of $expected"; exit 1; }
}

exchange() {
  say "The ladder program is exchanged while the robot works. One that would drop the parts is first compared with it: it differs"
  reload 4 main_drops.so --shadow 8s
  say "One with another rung is equal, and continues where the ladder was"
  reload 0 main_remembers.so --shadow 2s --health 1s
  say "One with a fault lights the red lamp: the previous one is back two periods later, and the operator starts the cell again"
  reload 5 main_wrong.so --guard 'O4 < 1'
  show indurop set --node cell CELL::panel.start true
  wait_for cell ROBOT_MODULE_STATE.eState ROBOT_GROUP_MOVING
  indurop set --node cell CELL::panel.start false
}

finish() {
  indurop stop --node "$1" >/dev/null
  wait $runner || true
  runner=
}

# page NODE: the cell at work until Ctrl-C, for a browser
page() {
  indurop run module.xml --node "$1" -q &
  runner=$!
  wait_for "$1" I14 1
  indurop set --node "$1" CELL::tour true
  watched=main.xml,plc_robot.glb,cell.glb
  indurop serve --node "$1" --plc $watched --write &
  server=$!
  wait $server || {
    indurop serve --node "$1" --plc $watched --write --port 0 & # another program has the usual port
    server=$!
    wait $server
  }
}

if [ "$1" = page ]; then
  page=demo$$
  say "The robot cell works: a browser shows its ladder, its robot, its alarms; Ctrl-C ends it"
  page $page
  exit 0
fi

forget
say "The PLC program of the cell, two of its rungs; all of them are drawn in main.svg"
indurop plc print main.xml | awk '/^rung (10|16)[: ]/ { on = 1 } /^$/ { if (on) print; on = 0 } on'
indurop plc print main.xml --svg main.svg >/dev/null
show indurop check module.xml
say "\$ indurop run module.xml --node cell &"
indurop run module.xml --node cell -q &
runner=$!
say "A visitor starts the cell, walks through the light curtain and hits the emergency stop (ROBOT_GROUP_ERRORSTOP); its job goes on after that"
tour cell cell cell.csv
show indurop jitter --node cell --no-histogram
show indurop get --node cell EMERGENCY_STOP CELL::world
show indurop chart cell.csv
picture cell.csv cell.svg "Robot cell: joints, states and signals of twenty seconds"
indurop plan module.xml --svg schedule.svg -q
exchange
finish cell

say "The same cell on two boards: the PLC program and its points on one, the robot and its drives on the other"
say "\$ indurop run plant.xml --local &"
indurop run plant.xml --local -q &
runner=$!
watch_alarms motion plc
tour motion plc cell_two_boards.csv
show indurop status --node motion
show indurop get --node plc CELL::world
picture cell_two_boards.csv cell_two_boards.svg "Robot cell on two boards"
kill $watchers $runner 2>/dev/null || true
wait $watchers $runner || true
watchers=
runner=
say "Pictures: $(pwd -P)/cell.svg, cell_two_boards.svg, main.svg (ladder), schedule.svg"

# Where a user watches, the cell continues.
[ -t 1 ] || exit 0
say "The cell goes on: a browser shows its ladder, its robot, its alarms; Ctrl-C ends it"
page cell
