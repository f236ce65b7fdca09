#!/bin/sh
# fuzz.sh BUILD TIME JOBS: runs each fuzz target for TIME (90s, 10m, 2h), JOBS at a time, and tells what it found. Fails if
# an input breaks one. New inputs and findings stay in BUILD/tests/fuzz/<target>.
set -eu
folder=$1/tests/fuzz
jobs=$3
number=${2%[smh]}
case $number in '' | *[!0-9]*) echo "fuzz: '$2' is no time; use T=90s, T=10m or T=2h" >&2; exit 2 ;; esac
case $2 in *h) seconds=$((number * 3600)) ;; *m) seconds=$((number * 60)) ;; *) seconds=$number ;; esac
[ -s "$folder/targets.txt" ] || { echo "fuzz: no fuzz targets; they need the package clang" >&2; exit 2; }

echo "$(wc -l <"$folder/targets.txt") targets, $seconds s each, $jobs at a time"
# Each line: the name of a target and its command, without quotes or spaces inside of words.
sed "s/ SECONDS / $seconds /" "$folder/targets.txt" | xargs -P "$jobs" -d '\n' -n 1 sh -c '
  name=${1%% *}
  mkdir -p "$0/$name/found"
  if ${1#* } >"$0/$name/log" 2>&1; then result=ok; else result="FAILED, see $0/$name/log"; fi
  new=$(ls "$0/$name/new" 2>/dev/null | wc -l)
  runs=$(sed -n "s/^stat::number_of_executed_units: *//p" "$0/$name/log")
  echo "$name: ${runs:-?} inputs run, $new kept in $0/$name/new: $result"' "$folder"
found=$(find "$folder"/*/found -type f)
[ -z "$found" ] || { echo "inputs that break a target:"; echo "$found"; exit 1; }
