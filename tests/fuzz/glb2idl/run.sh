#!/bin/sh
# run.sh FUZZER CORPUS GOLDEN WORK: a bounded run from the corpus and the golden cases. Findings stay in WORK.
set -eu
fuzzer=$1
corpus=$2
golden=$3
work=$4
rm -rf "$work"
mkdir -p "$work/new" "$work/cases"
for case in "$golden"/*/in.glb; do
  cp "$case" "$work/cases/$(basename "$(dirname "$case")").glb"
done
cd "$work"
"$fuzzer" -seed=1 -runs=20000 -max_total_time="${INDUROP_FUZZ_SECONDS:-20}" -max_len=4096 -timeout=10 -rss_limit_mb=2048 -verbosity=0 \
  -print_final_stats=1 -dict="$corpus/../glb.dict" "$work/new" "$corpus" "$work/cases"
