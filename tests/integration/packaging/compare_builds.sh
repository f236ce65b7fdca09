#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# compare_builds.sh DEBS WORK: builds the packages again, in another folder, without ccache, with other rights of new files,
# another zone of time and language, and compares them byte by byte with those in DEBS.
set -eu
debs=$(cd "$1" && pwd)
work=$2
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work/in/another/place"
(
  umask 0002
  export CCACHE_DISABLE=1 TZ=Pacific/Kiritimati LANG=C
  "$here/../../../cmake/packaging/make_deb.sh" "$work/in/another/place"
)
differ=0
for file in "$debs"/*.deb "$debs"/dbgsym/*.deb; do
  other=$work/in/another/place/${file#"$debs/"}
  if cmp -s "$file" "$other"; then
    echo "equal  $(sha256sum "$file" | cut -c1-16)  ${file##*/}"
  else
    echo "DIFFER ${file##*/}"
    differ=1
    if command -v diffoscope >/dev/null; then diffoscope "$file" "$other" || true; fi
  fi
done
exit $differ
