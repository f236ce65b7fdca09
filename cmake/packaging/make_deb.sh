#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# make_deb.sh [FOLDER]: builds the Debian packages of the committed tree, in build/deb or FOLDER; symbols go to dbgsym/.
# The page of indurop serve and indurop-opcua are taken from build/: a build of a package has no network. JOBS: compilers side by side.
# ARCH=arm64: built for that architecture in the Debian of cmake/arm64_root.sh.
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
cd "$top"
out=${1:-build/deb}
page=build/share/indurop/web
opcua=build/share/indurop/opcua
version=$(sed -n 's/^project(InduRoP VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
jobs=${JOBS:-$(nproc)}
arch=${ARCH:-$(dpkg --print-architecture)}
inside=
# What cannot be cross-compiled (ROS 1 in Debian) is left out.
profile=
[ "$arch" = "$(dpkg --print-architecture)" ] || { inside=$top/cmake/arm64_root.sh profile=cross; }

[ -e $opcua/package.json ] || { echo "make deb: there is no indurop-opcua in $opcua; it needs nodejs and npm: make builds it" >&2; exit 1; }
[ -e $page/index.html ] || { echo "make deb: there is no page in $page; it needs nodejs and npm: make demo builds it" >&2; exit 1; }
if [ -n "$(git status --porcelain --untracked-files=no)" ]; then
  echo "make deb: changes that are not committed are left out" >&2
fi

mkdir -p "$out"
out=$(cd "$out" && pwd)
tree=$out/indurop-$version
# What was compiled before stays, and with it the time of files that did not change.
fresh=$out/fresh
rm -rf "$fresh" "$tree/debian" && mkdir -p "$fresh" "$tree"
git archive HEAD | tar -x -C "$fresh"
cp -r "$fresh/cmake/packaging/debian" "$fresh/debian"
cp -r $page "$fresh/debian/page"
cp -r $opcua "$fresh/debian/opcua"
{
  echo "indurop ($version) bookworm; urgency=medium"
  echo
  echo "  * Release $version: /usr/share/doc/indurop/CHANGELOG.md says what is new."
  echo
  echo " -- $(sed -n 's/^Maintainer: //p' "$fresh/debian/control")  $(LC_ALL=C TZ=UTC0 git log -1 --date=rfc-local --format=%cd)"
} >"$fresh/debian/changelog"
chmod -R u=rwX,go=rX "$fresh"
$inside rsync -r --links --perms --checksum --delete --exclude '/obj-*' "$fresh/" "$tree/"
rm -rf "$fresh"

rm -rf "$out"/*.deb "$out"/*.changes "$out"/*.buildinfo "$out/dbgsym"
cd "$tree"
$inside env LC_ALL=C.UTF-8 DEB_BUILD_OPTIONS="parallel=$jobs nocheck ${DEB_BUILD_OPTIONS:-}" DEB_BUILD_PROFILES=$profile dpkg-buildpackage -b -us -uc -a "$arch"
if $inside sh -c 'command -v lintian' >/dev/null; then
  $inside lintian --fail-on error,warning --allow-root "$out"/indurop_"$version"_*.changes
fi
"$top/cmake/packaging/check_architecture.py" "$arch" "$out"/*.deb
mkdir -p "$out/dbgsym"
mv "$out"/*-dbgsym_*.deb "$out/dbgsym"
echo "packages: $out/*.deb"
