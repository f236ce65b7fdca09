#!/bin/sh
# run.sh FOLDER_OF_PROGRAMS: makes a project, builds it as it is, checks it, runs it, reads it from outside.
set -eu
programs=$1
folder=$(mktemp -d)
export INDUROP_NODE=new_project_$$ INDUROP_STATE_DIR="$folder/state"
runner=
cleanup() {
  [ -z "$runner" ] || kill "$runner" 2>/dev/null || true
  [ -z "$runner" ] || wait "$runner" 2>/dev/null || true
  for node in "$INDUROP_NODE" "$INDUROP_NODE-board1" "$INDUROP_NODE-board2" "$INDUROP_NODE-board3"; do
    "$programs/indurop" clean -q --node "$node" >/dev/null 2>&1 || true
  done
  rm -rf "$folder"
}
trap cleanup EXIT
fail() { echo "FAILED: $*"; [ ! -f run.log ] || cat run.log; exit 1; }

if nm -C "$programs/indurop" 2>/dev/null | grep -qE '__(asan|tsan)_init'; then
  echo "modules of a plain project cannot be loaded into a sanitizer build"
  exit 77
fi
cd "$folder"
"$programs/indurop" new cell-7
cd cell-7
make
PATH="$programs:$PATH"
indurop check || fail "check of a fresh project"
make test || fail "the tests of a fresh project"
grep -q 'name="cell-7"' build/tests.xml || fail "no JUnit report"
indurop plan -o json | grep -q '"basic_period_ns": *1000000' || fail "plan"
indurop run --duration 20s >run.log 2>&1 &
runner=$!
tries=0
until indurop get seen.samples >/dev/null 2>&1 && [ "$(indurop get -q seen.samples)" -ge 12 ]; do
  tries=$((tries + 1))
  [ $tries -lt 200 ] || fail "the monitor process does not run"
  sleep 0.05
done
indurop set gain 2.5
[ "$(indurop get gain)" = 2.5 ] || fail "set"
indurop set gain 11 2>/dev/null && fail "a value beyond its range was taken"
indurop status || fail "status"
indurop vars | grep -q 'wave.*smooth' || fail "vars does not know writers and readers"
indurop jitter | grep -q response || fail "jitter"
indurop stop || fail "stop"
wait "$runner" || true
runner=
grep -q smoothed run.log || fail "the monitor printed nothing"

# With a PLC program, and dealt out to three boards.
cd "$folder"
indurop new line --with plc --boards 3
cd line
make
indurop check || fail "check of a fresh project with a PLC program"
make test || fail "the tests of a fresh project with a PLC program"
indurop check plant.xml || fail "check of a fresh plant"
grep -q logic.st README.md && grep -q plant.xml README.md || fail "the README does not name all files"
indurop run plant.xml --sim --until 2s || fail "the fresh plant in virtual time"
[ "$(grep -c '<board' plant.xml)" = 3 ] || fail "not three boards"

# The same sources in another folder give the same modules, byte by byte.
digests() { (cd "$1" && sha256sum ./*.so ./*.exe | sort); }
[ "$(digests build | wc -l)" -ge 4 ] || fail "not all modules are there: $(digests build)"
mkdir -p "$folder/pulled/by another user"
cp -r . "$folder/pulled/by another user/line"
cd "$folder/pulled/by another user/line"
rm -rf build
make
[ "$(digests build)" = "$(digests "$folder/line/build")" ] ||
  fail "another folder, other modules: $(digests build) instead of $(digests "$folder/line/build")"
