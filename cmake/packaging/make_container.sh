#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# make_container.sh [DEBS]: an image for containers, indurop:VERSION, in podman's store: Debian 12 made by mmdebstrap, with the
# packages indurop, indurop-plc, indurop-robot and indurop-examples of build/deb or DEBS. No registry is asked for anything.
set -eu
cd "$(dirname "$0")/../.."
debs=$(cd "${1:-build/deb}" 2>/dev/null && pwd) || debs=
packages="indurop indurop-plc indurop-robot indurop-examples"
for tool in podman mmdebstrap; do
  command -v $tool >/dev/null || { echo "make container: the command $tool is missing; install the package $tool" >&2; exit 1; }
done
files=
for package in $packages; do
  file=$(ls "$debs/${package}"_*.deb 2>/dev/null) || { echo "make container: there is no $package in ${debs:-build/deb}: make deb builds it" >&2; exit 1; }
  files="$files $file"
done
# shellcheck disable=SC2086 # a list of files
set -- $files
version=$(dpkg-deb -f "$1" Version)
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH

# The packages are installed by the new Debian's own apt, which fetches the libraries that they need.
part=$(mktemp -d)
trap 'rm -rf "$part"' EXIT
mmdebstrap --quiet --variant=minbase --aptopt='APT::Install-Recommends "0"' --dpkgopt='path-exclude=/usr/share/doc/*' \
  --dpkgopt='path-include=/usr/share/doc/*/copyright' --dpkgopt='path-exclude=/usr/share/man/*' --dpkgopt='path-exclude=/usr/share/locale/*' \
  --customize-hook='mkdir "$1/debs"' --customize-hook="copy-in $* /debs" \
  --customize-hook='chroot "$1" sh -c "DEBIAN_FRONTEND=noninteractive apt-get -qq install -y /debs/*.deb >/dev/null && rm -r /debs"' \
  bookworm "$part/root.tar"
podman import --quiet --change 'CMD ["indurop-agent"]' --change 'VOLUME /var/lib/indurop' --change 'ENV LANG=C.UTF-8' \
  --change "LABEL org.opencontainers.image.title=InduRoP" --change "LABEL org.opencontainers.image.version=$version" \
  --change "LABEL org.opencontainers.image.licenses=Apache-2.0" "$part/root.tar" "indurop:$version" >/dev/null
echo "image: localhost/indurop:$version
  podman run --rm -it --network host --init localhost/indurop:$version indurop demo"
