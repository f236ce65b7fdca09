#!/bin/sh
# docs_test.sh GLB2IDL DOCUMENT WORK: every block of .glb text in the language reference compiles.
set -eu
glb2idl=$1
document=$2
work=$3
rm -rf "$work"
mkdir -p "$work"
awk -v work="$work" '
  /^```c$/ { number++; inside = 1; next }
  /^```/ { inside = 0 }
  inside { print > (work "/block" number ".glb") }
' "$document"
set -- "$work"/block*.glb
[ -e "$1" ] || { echo "no block found in $document" >&2; exit 1; }
for block in "$@"; do
  "$glb2idl" --check "$block"
done
