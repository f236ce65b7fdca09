#!/bin/sh
# program_test.sh GLB2IDL WORK: options, exit codes and files of the program glb2idl.
set -u
glb2idl=$1
work=$2
rm -rf "$work"
mkdir -p "$work/src/parts"
cd "$work" || exit 1
failures=0

check() {
  if ! eval "$2"; then
    echo "failed: $1" >&2
    failures=$((failures + 1))
  fi
}
run() {
  "$glb2idl" "$@" >out.txt 2>err.txt
  code=$?
}

echo 'include "parts/arm.glb"
int32_t a;' >src/cell.glb
echo 'namespace arm; int32_t b;' >src/parts/arm.glb
echo 'int8_t c = 300;' >src/bad.glb

run
check "no file is wrong usage" '[ $code = 2 ] && grep -q "no .glb file given" err.txt'
run --nonsense src/cell.glb
check "unknown options are wrong usage" '[ $code = 2 ]'
run -o
check "a missing value is wrong usage" '[ $code = 2 ]'
run --help
check "--help" '[ $code = 0 ] && grep -q Usage out.txt && [ ! -s err.txt ]'
run --version
check "--version" '[ $code = 0 ] && grep -q glb2idl out.txt'

run --check src/cell.glb
check "--check writes nothing" '[ $code = 0 ] && [ "$(find . -name "*.idl" | wc -l)" = 0 ]'
run -o out src/bad.glb
check "errors in the file" '[ $code = 1 ] && grep -q "^src/bad.glb:1:12: error: " err.txt && [ ! -e out ]'
run -o out missing.glb
check "a missing file" '[ $code = 1 ] && grep -q "glb2idl: error: cannot read .missing.glb" err.txt'
run -o out src
check "a folder" '[ $code = 1 ] && grep -q "it is a directory" err.txt'

run -o out --depfile out/dep.d src/cell.glb
check "outputs of the file and what it includes" '[ $code = 0 ] && [ -s out/cell.idl ] && [ -s out/cell.glb.h ] &&
  [ -s out/cell.layout.txt ] && [ -s out/arm.glb.h ] && [ -s out/indurop/generated.h ]'
check "silent when all is well" '[ ! -s out.txt ] && [ ! -s err.txt ]'
check "the dependency file names all sources" 'grep -q "^out/indurop/generated.h:" out/dep.d &&
  grep -q "$work/src/cell.glb" out/dep.d && grep -q "$work/src/parts/arm.glb" out/dep.d'
touch -d '2020-01-01' out/*.* out/indurop/*
run --out-dir=out src/cell.glb
check "unchanged outputs keep their time" '[ "$(find out -type f -newermt 2021-01-01 | wc -l)" = 0 ]'
echo 'int32_t more;' >>src/cell.glb
run --out-dir out -- src/cell.glb
check "changed outputs are written" '[ "$(find out -type f -newermt 2021-01-01 | wc -l)" = 3 ]'

echo x >in_the_way
run -o in_the_way src/cell.glb
check "a folder that cannot be made" '[ $code = 1 ] && grep -q "cannot write" err.txt'
exit $failures
