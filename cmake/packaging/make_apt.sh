#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# make_apt.sh [FOLDER [DEBS]]: makes a signed apt repository of the packages in build/deb or DEBS, in build/apt or FOLDER. The key is
# made by the first run and stays in ~/.local/share/indurop/apt, or where $INDUROP_APT_KEYS says.
set -eu
cd "$(dirname "$0")/../.."
out=${1:-build/apt}
packages=${2:-build/deb}
keys=${INDUROP_APT_KEYS:-${XDG_DATA_HOME:-$HOME/.local/share}/indurop/apt}

ls "$packages"/indurop_*.deb >/dev/null 2>&1 || { echo "make apt: there are no packages in $packages: make deb builds them" >&2; exit 1; }
mkdir -p "$keys"
chmod 700 "$keys"
export GNUPGHOME="$keys"
if ! gpg --batch --list-secret-keys indurop-apt >/dev/null 2>&1; then
  echo "make apt: making the key of the repository in $keys: keep it, machines trust what it signs"
  gpg --batch --quiet --pinentry-mode loopback --passphrase '' --quick-generate-key 'InduRoP packages (indurop-apt)' rsa3072 sign never
fi

rm -rf "$out"
mkdir -p "$out"
find "$packages" -maxdepth 2 -name '*.deb' -exec cp -t "$out" {} +
cd "$out"
apt-ftparchive packages . >Packages
gzip -9nk Packages
apt-ftparchive -o APT::FTPArchive::Release::Origin=InduRoP -o APT::FTPArchive::Release::Label=InduRoP \
  -o APT::FTPArchive::Release::Suite=indurop release . >Release.new
mv Release.new Release
gpg --batch --quiet --yes --local-user indurop-apt --clearsign --output InRelease Release
gpg --batch --quiet --yes --local-user indurop-apt --armor --detach-sign --output Release.gpg Release
gpg --batch --quiet --yes --armor --export --output indurop.asc indurop-apt
cat >indurop.sources <<SOURCES
# For /etc/apt/sources.list.d/: where apt finds these packages. On another machine: http://... instead of file:...
Types: deb
URIs: file:$(pwd)
Suites: ./
Signed-By: /etc/apt/keyrings/indurop.asc
SOURCES
echo "repository: $(pwd)
on a machine that is to use it, as root:
  install -D -m 644 $(pwd)/indurop.asc /etc/apt/keyrings/indurop.asc
  install -m 644 $(pwd)/indurop.sources /etc/apt/sources.list.d/indurop.sources
  apt update && apt install indurop indurop-examples"
