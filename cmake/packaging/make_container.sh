#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# make_container.sh [DEBS [OUT]]: an image of a board for podman and docker: Debian 12 with the package indurop of DEBS, in OUT
# (build/deb, build/container). Needs podman, mmdebstrap and a Debian mirror. $PODMAN: another command for podman.
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
cd "$top"
debs=${1:-build/deb}
out=${2:-build/container}
deb=$(find "$debs" -maxdepth 1 -name "indurop_*_$(dpkg --print-architecture).deb" | head -n 1)
[ -n "$deb" ] || { echo "make container: there is no package indurop in $debs; make deb builds it" >&2; exit 1; }
version=$(dpkg-deb -f "$deb" Version)
name=localhost/indurop:$version
mkdir -p "$out"
rm -f "$out"/*.tar

# The same package, and the same packages of Debian, give the same files with the same times.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
# shellcheck disable=SC2016 # $1 is for mmdebstrap
mmdebstrap --quiet --variant=minbase --dpkgopt='path-exclude=/usr/share/man/*' --dpkgopt='path-exclude=/usr/share/doc/*' \
  --customize-hook="copy-in $deb /root" \
  --customize-hook='chroot "$1" sh -c "DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends /root/*.deb"' \
  --customize-hook='rm "$1"/root/*.deb' bookworm "$out/root.tar" >"$out/log" 2>&1 || { tail -n 20 "$out/log" >&2; exit 1; }
${PODMAN:-podman} import --quiet --change 'USER indurop' --change 'WORKDIR /var/lib/indurop' --change 'VOLUME /var/lib/indurop' \
  --change 'STOPSIGNAL SIGTERM' --change 'CMD ["indurop", "doctor"]' "$out/root.tar" "$name" >/dev/null
rm "$out/root.tar"
${PODMAN:-podman} save --quiet --output "$out/indurop_${version}_$(dpkg --print-architecture).tar" "$name"
echo "image $name, also in $(echo "$out"/*.tar)"
