#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# check_deb.sh BUILD WORK VERSION: cpack makes a package whose control file and contents are sane.
set -u
build=$1
work=$2
version=$3
for tool in cpack dpkg-deb dpkg-shlibdeps; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
failures=0
check() {
  if ! eval "$2"; then
    echo "failed: $1" >&2
    failures=$((failures + 1))
  fi
}
rm -rf "$work"
mkdir -p "$work"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
package=$(ls "$work"/*.deb)
field() { dpkg-deb -f "$package" "$1"; }
files=$(dpkg-deb -c "$package" | awk '{print $6}')
has() { echo "$files" | grep -qx "\./$1"; }
check "name" '[ "$(field Package)" = indurop ]'
check "version" '[ "$(field Version)" = "$version" ]'
check "architecture" '[ "$(field Architecture)" = "$(dpkg --print-architecture)" ]'
check "maintainer" 'field Maintainer | grep -q InduRoP'
check "dependencies of the libraries it is linked with" 'field Depends | grep -q libc6 && field Depends | grep -q libfmt'
check "no dependency on itself" '! field Depends | grep -q indurop'
check "programs" 'has usr/bin/indurop && has usr/bin/indurop-node && has usr/bin/indurop-agent && has usr/bin/glb2idl'
check "man pages" 'has usr/share/man/man1/indurop.1 && has usr/share/man/man1/indurop-lab.1'
check "completion" 'has usr/share/bash-completion/completions/indurop &&
  has usr/share/zsh/site-functions/_indurop && has usr/share/fish/vendor_completions.d/indurop.fish'
check "the service names the installed programs" 'dpkg-deb --fsys-tarfile "$package" |
  tar -xO ./usr/lib/systemd/system/indurop-agent@.service | grep -q "^ExecStart=/usr/bin/indurop-agent"'
check "nothing outside /usr" '! echo "$files" | grep -v "^\./\(usr/.*\)\?$" | grep -q .'
exit $((failures > 0))
