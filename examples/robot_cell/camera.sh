#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The bench of camera.xml at work for forty seconds: parts under a camera, then a stack, with a picture of each.
# `camera.sh page`: after that, with its page until Ctrl-C. Needs the programs in PATH and the built example.
set -e
folder=${INDUROP_DEMO_DIR:-$(cd "$(dirname "$0")" && pwd)}
[ -f "$folder/camera.so" ] || folder=$folder/../../build/examples/robot_cell
cd "$folder"
PATH=$folder/../../bin:$PATH
export INDUROP_NODE=bench$$

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
show() { say "\$ $*"; "$@"; }
runner=
recorder=
cleanup() {
  for pid in $recorder $runner; do kill "$pid" 2>/dev/null || true; done
  for pid in $recorder $runner; do wait "$pid" 2>/dev/null || true; done
  indurop clean --node "$INDUROP_NODE" >/dev/null 2>&1 || true
}
trap cleanup EXIT
trap 'exit 130' INT TERM HUP

# wait_for TRIES VARIABLE PATTERN
wait_for() {
  tries=0
  until indurop get "$2" 2>/dev/null | grep -qE "^($3)\$"; do
    tries=$((tries + 1))
    kill -0 "$runner" 2>/dev/null || { echo "the node has ended: its messages are above"; exit 1; }
    [ $tries -lt "$1" ] || { echo "$2 did not become $3"; exit 1; }
    sleep 0.1
  done
}

# job NUMBER NAME TITLE VARIABLE=LABEL...: runs it to its end, and draws what happened
job() {
  number=$1 name=$2 title=$3
  shift 3
  set -- "$@" ROBOT_JOB.eState=job 'I4=I4: holds it'
  variables=
  for shown in "$@"; do
    variables="$variables ${shown%%=*}"
    set -- "$@" --name "$shown"
    shift
  done
  # shellcheck disable=SC2086 # names, one word each
  indurop watch ROBOT_ARM.joint ROBOT_ARM.position ROBOT_ARM.tool_speed $variables --hz 25 -o csv --units >"$name.csv" &
  recorder=$!
  show indurop set BENCH::job "$number"
  wait_for 100 ROBOT_JOB.eState 'ROBOT_JOB_RUNS|ROBOT_JOB_WAITS'
  wait_for 3000 ROBOT_JOB.eState 'ROBOT_JOB_ENDED|ROBOT_JOB_FAILED'
  kill "$recorder"
  wait "$recorder" || true
  recorder=
  show indurop get ROBOT_JOB.cMessage BENCH::truth
  for joint in 1 2 3 4 5 6; do
    set -- "$@" --name "ROBOT_ARM.joint[$((joint - 1))]=J$joint"
  done
  indurop chart "$name.csv" --svg "$name.svg" --title "$title" -q --way ROBOT_ARM.position "$@" \
    --name 'ROBOT_ARM.joint=joints, deg' --name 'ROBOT_ARM.tool_speed=tool speed, mm/s'
}

say "\$ indurop run camera.xml &"
indurop run camera.xml -q &
runner=$!
wait_for 100 I14 1
show indurop get BENCH::scene
job 1 sort "Turned parts are taken from under the camera" CAMERA::shot='images taken' CAMERA::seen.parts='parts seen' \
  BENCH::truth.put='put down'
job 2 unstack "The height of a stack is searched" 'I8=I8: sees a piece' STACK::top='height found' BENCH::truth.put='put down'
say "Pictures: $(pwd -P)/sort.svg, unstack.svg"
[ "$1" = page ] || exit 0
say "A browser shows the robot and all variables; indurop set BENCH::scene.seed 2 --node $INDUROP_NODE lays out other parts; Ctrl-C ends it"
indurop serve --write
