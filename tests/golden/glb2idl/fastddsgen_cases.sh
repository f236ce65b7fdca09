#!/bin/sh
# fastddsgen_cases.sh GLB2IDL FOLDER WORK: another vendor's compiler accepts the IDL of all golden cases.
# Exit code 77 (skipped) if it is not installed.
set -eu
glb2idl=$1
folder=$2
work=$3
if ! command -v fastddsgen >/dev/null || ! command -v java >/dev/null; then
  echo "skipped: fastddsgen or java is not installed"
  exit 77
fi
rm -rf "$work"
for expected in "$folder"/*/expected.idl; do
  case=$(basename "$(dirname "$expected")")
  mkdir -p "$work/$case/out"
  "$glb2idl" -o "$work/$case" "$folder/$case/in.glb"
  cd "$work/$case"
  fastddsgen -cs -replace -d out ./*.idl >messages.txt 2>&1 || { cat messages.txt; exit 1; }
  if grep -qiE 'error|warning|exception' messages.txt; then
    cat messages.txt
    exit 1
  fi
done
