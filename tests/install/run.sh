#!/bin/sh
# Builds the user's project outside of the tree, against an installation or against the build tree, and uses it.
# Usage: run.sh installed|build-tree BUILD_DIR WORK_DIR
set -eu
kind=$1 build=$2 work=$3
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
cp -r "$here/project" "$work/project"

case $kind in
  installed)
    cmake --install "$build" --prefix "$work/first" >"$work/install.log"
    # `make uninstall` removes what is listed there.
    sort "$build/install_manifest.txt" >"$work/listed"
    find "$work/first" -type f -o -type l | sort >"$work/written"
    diff "$work/listed" "$work/written" || { echo "the list of installed files is not what was installed" >&2; exit 1; }
    # An installation is not tied to the place it was made for.
    mv "$work/first" "$work/prefix"
    set -- -DCMAKE_PREFIX_PATH="$work/prefix"
    programs=$work/prefix/bin
    ;;
  build-tree)
    set -- -DInduRoP_DIR="$build"
    programs=$build/bin
    ;;
esac

cmake -G Ninja -S "$work/project" -B "$work/out" -DCMAKE_BUILD_TYPE=Release "$@"
cmake --build "$work/out" -j 2
cd "$work/out"
for file in output.so modify.so event1.so mixer.so observer.exe libvariables_types.so; do
  [ -f "$file" ] || { echo "missing: $file" >&2; exit 1; }
done
./types

# A changed .glb rebuilds what includes it; an unchanged one rebuilds nothing.
cmake --build . >unchanged.log
grep -q 'no work to do' unchanged.log || { echo "an unchanged project is built again" >&2; exit 1; }
printf 'uint8_t added;\n' >>"$work/project/knuRobot.glb"
cmake --build . >changed.log
grep -q 'Building CXX object.*modify' changed.log || { echo "a changed .glb rebuilds nothing" >&2; exit 1; }

# Undefined symbols are found by the linker, not when the node loads the module.
printf 'void nowhere();\nvoid onRun() { nowhere(); }\n' >>"$work/project/event1.cpp"
if cmake --build . --target event1 >undefined.log 2>&1 || ! grep -q 'nowhere' undefined.log; then
  echo "an undefined symbol was not reported at link time" >&2
  exit 1
fi
sed -i '/nowhere/d' "$work/project/event1.cpp"
cmake --build . >/dev/null

# And it runs, with the programs found next to the library.
node=install-test-$$
export INDUROP_STATE_DIR="$work/state"
trap '"$programs/indurop" clean --node "$node" >/dev/null 2>&1 || true' EXIT
"$programs/indurop" check module.xml
# The I/O module is next to the library and finds what it links.
io=$(find "$(dirname "$programs")"/lib* -name libiodispat.so -type f -print -quit)
if [ -z "$io" ] || ldd "$io" | grep 'not found'; then
  echo "libiodispat.so is missing, or something it needs: '$io'" >&2
  exit 1
fi
"$programs/indurop" run module.xml --node "$node" --duration 1s --report report.json >run.log 2>&1 || { cat run.log; exit 1; }
grep -q '"name": "observer"' report.json
grep -q '"name": "mixer"' report.json
grep -q 'joints\[0\] = {' run.log
