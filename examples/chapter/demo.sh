#!/bin/sh
# The chapter's modules on their own schedule: plan, check, run, look from outside, kill a process, statistics.
# Needs the programs in PATH; `make demo` and `indurop demo` see to it.
set -e
here=$(cd "$(dirname "$0")" && pwd)
folder=${INDUROP_DEMO_DIR:-$here/../../build/examples/chapter}
cd "$folder"
node=demo$$
export INDUROP_NODE=$node

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
show() { say "\$ $*"; "$@"; }
cleanup() {
  [ -z "$runner" ] || kill "$runner" 2>/dev/null || true
  [ -z "$runner" ] || wait "$runner" 2>/dev/null || true
  indurop clean --node "$node" >/dev/null 2>&1 || true
}
trap cleanup EXIT
trap 'exit 130' INT TERM

say "Figures 4 and 5: one module changes the variables of Figure 3, another prints them"
show indurop run figures4and5.xml --duration 1s

say "Figure 1: seven modules. Their schedule is Table 3 of the chapter:"
show indurop plan module.xml
show indurop check module.xml

say "\$ indurop run module.xml --duration 8s &"
indurop run module.xml --duration 8s --report report.json &
runner=$!
tries=0
until indurop get knu::Robot::tick >/dev/null 2>&1; do
  tries=$((tries + 1))
  [ $tries -lt 100 ] || { echo "the node did not start"; exit 1; }
  sleep 0.05
done
sleep 2
show indurop watch 'knu::Robot::tick' 'joint[0].x' 'total' -n 3
show indurop status
say "A process module dies (kill -9) and comes back:"
victim=$(indurop status -o csv | awk -F, '$1 == "cntr4" { print $7 }')
echo "\$ kill -9 $victim"; kill -9 "$victim"
sleep 1
show indurop status
wait "$runner"
runner=
show indurop jitter
say "The statistics as JSON are in $(pwd)/report.json, the timing diagram in $(pwd)/plan.svg"
indurop plan module.xml --svg plan.svg >/dev/null
