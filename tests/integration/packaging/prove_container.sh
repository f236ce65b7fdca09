#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_container.sh DEBS WORK: the image of make_container.sh as a board: what the doctor says without rights, a plant that is
# deployed with rights, a container that is killed and one that is replaced. $PODMAN: another command for podman; $PODMAN_RUN: more
# options of `podman run`, for machines on which podman cannot make control groups; $PODMAN_RIGHTS: options in place of those that
# raise limits, for machines whose root may not do that.
# shellcheck disable=SC2016 # texts in single quotes are for shells inside
set -eu
here=$(cd "$(dirname "$0")" && pwd)
debs=$(cd "$1" && pwd)
mkdir -p "$2"
work=$(cd "$2" && pwd)
podman=${PODMAN:-podman}
volume=indurop-proof-$$
name=indurop-proof-$$
rights=${PODMAN_RIGHTS:---ulimit rtprio=99 --ulimit memlock=-1}
. "$here/checks.sh"

tidy() {
  $podman rm --force --time 0 $name >/dev/null 2>&1 || true
  $podman volume rm $volume >/dev/null 2>&1 || true
}
trap tidy EXIT
trap 'exit 130' INT TERM

"$here/../../../cmake/packaging/make_container.sh" "$debs" "$work/image"
image=localhost/indurop:$(dpkg-deb -f "$debs"/indurop_*.deb Version)
rm -rf "$work/plant"
for deb in "$debs"/indurop-examples_*.deb; do dpkg-deb -x "$deb" "$work/examples"; done
cp -r "$work"/examples/usr/lib/*/indurop/examples/two_boards "$work/plant"
# Both boards are one here: what is shown is the container, not the network.
cat >"$work/plant/plant.xml" <<'XML'
<plant name="contained"><board name="inside"><module><filename>./table.so</filename><moduletype>thread</moduletype>
<operationtype>periodic</operationtype><period>1ms</period><priority>1</priority></module></board></plant>
XML
chmod -R a+rX "$work/plant"

# shellcheck disable=SC2086 # lists of words
start() { # OPTIONS...: the board's container, with all that docs/target.md gives it
  $podman run ${PODMAN_RUN:-} --detach --name $name --network none --init $rights --shm-size 256m \
    --volume $volume:/var/lib/indurop --volume "$work/plant:/plant:ro" "$@" "$image" indurop-agent --board inside --one-host >/dev/null
}
inside() { $podman exec $name "$@"; }
until_it() { # COMMAND...: once it succeeds
  tries=0
  until "$@"; do
    tries=$((tries + 1))
    [ $tries -lt 120 ] || return 1
    sleep 0.5
  done
}
counts() { [ "$(inside indurop get --node inside encoder.count)" -gt "${1:-0}" ]; }

# shellcheck disable=SC2086 # a list of words
$podman run ${PODMAN_RUN:-} --rm --network none "$image" indurop doctor >"$work/doctor" 2>&1 || true
check "without rights, the doctor names the options that give them" sh -c 'cat "$0"; grep -q -- "--ulimit" "$0" && grep -q -- "rtprio=99" "$0" &&
  grep -q -- "memlock=-1" "$0" && grep -q "container  *yes" "$0"' "$work/doctor"
start
check "with rights, the doctor finds nothing that fails" sh -c '"$@" indurop doctor -o json | grep -q "\"fifo\"" &&
  "$@" indurop doctor | tee /dev/stderr | grep -q " 0 FAIL"' sh $podman exec $name
check "nothing runs as root" sh -c '[ "$("$@" id -un)" = indurop ]' sh $podman exec $name
check "no compiler is there" sh -c '! "$@" sh -c "command -v cc || command -v g++ || command -v cmake"' sh $podman exec $name
check "a plant is deployed" inside indurop deploy /plant/plant.xml --one-host --timeout 60s
check "its module runs" until_it counts
check "with real-time priority and locked memory" sh -c '"$@" | grep -q "\"fifo\": *true.*\"memory_locked\": *true\|\"memory_locked\": *true.*\"fifo\": *true"' sh \
  sh -c "$podman exec $name indurop status --node inside -o json | tr -d '\n'"
$podman kill $name >/dev/null
$podman start $name >/dev/null
check "the container was killed and started again: the plant resumes" until_it counts
$podman rm --force --time 0 $name >/dev/null
start
check "another container with the same volume resumes the plant" until_it counts
check "it stops by command" sh -c '"$@" stop --time 20 '$name' && [ "$("$@" inspect --format "{{.State.ExitCode}}" '$name')" = 0 ]' sh $podman
echo "$failures wrong"
exit $((failures > 0))
