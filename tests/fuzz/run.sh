#!/bin/sh
# run.sh PROGRAM FOLDER test|SECONDS [LIBFUZZER OPTION...] CORPUS...: runs one fuzz target.
# test: the corpus and at most 20 s more, with a fixed seed, so that a clone is tested the same way each time.
# SECONDS: for that long; new inputs stay in FOLDER/new and are used the next time. Crashes stay in FOLDER/found.
set -eu
program=$1
folder=$2
limit=$3
shift 3
mkdir -p "$folder/found"
if [ "$limit" = test ]; then
  new=$folder/scratch
  rm -rf "$new"
  set -- -seed=1 -runs=20000 -max_total_time=20 "$new" "$@"
else
  new=$folder/new
  set -- -max_total_time="$limit" "$new" "$@"
fi
mkdir -p "$new"
export ASAN_OPTIONS=allocator_may_return_null=1
exec "$program" -timeout=20 -rss_limit_mb=2048 -verbosity=0 -print_final_stats=1 -artifact_prefix="$folder/found/" "$@"
