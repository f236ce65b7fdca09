#!/bin/sh
# run.sh PROGRAM FOLDER SECONDS [LIBFUZZER OPTION...] CORPUS...: runs one fuzz target for SECONDS. New inputs stay in
# FOLDER/new and are used the next time. Crashes stay in FOLDER/found.
set -eu
program=$1
folder=$2
limit=$3
shift 3
mkdir -p "$folder/found" "$folder/new"
export ASAN_OPTIONS=allocator_may_return_null=1
exec "$program" -timeout=20 -rss_limit_mb=2048 -verbosity=0 -print_final_stats=1 -artifact_prefix="$folder/found/" \
  -max_total_time="$limit" "$folder/new" "$@"
