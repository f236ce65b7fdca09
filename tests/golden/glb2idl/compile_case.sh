#!/bin/sh
# compile_case.sh GLB2IDL CASE INCLUDE WORK: the outputs for one golden case are accepted, without a warning, by idlc,
# by the C compiler for what idlc makes, by g++ and clang++ for the header, and by gcc and clang for that of C.
set -eu
glb2idl=$1
input=$2/in.glb
include=$3
work=$4
rm -rf "$work"
mkdir -p "$work"
"$glb2idl" --c -o "$work" "$input"
cd "$work"

fail() {
  echo "compile_case: $*" >&2
  exit 1
}
quiet() {
  "$@" >messages.txt 2>&1 || { cat messages.txt >&2; fail "failed: $*"; }
  if [ -s messages.txt ]; then
    cat messages.txt >&2
    fail "not silent: $*"
  fi
}

if command -v idlc >/dev/null; then
  for idl in *.idl; do
    # Also without case sensitivity, as other vendors read it.
    quiet idlc -Wno-implicit-extensibility "$idl"
    quiet idlc -f case-sensitive -Wno-implicit-extensibility "$idl"
  done
  quiet gcc -std=c11 -Wall -Wextra -fPIC -c ./*.c
else
  echo "idlc is not installed: IDL not compiled"
fi

warnings="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Werror"
# The header alone, and behind the usual system headers with all their macros.
echo '#include <indurop/generated.h>' >alone.cpp
printf '#include <%s>\n' cmath cstdio iostream string unistd.h indurop/generated.h >behind.cpp
# shellcheck disable=SC2086
quiet g++ -std=c++20 $warnings -fPIC -I. -I"$include" -c alone.cpp
if command -v clang++-14 >/dev/null; then
  # shellcheck disable=SC2086
  quiet clang++-14 -std=gnu++20 $warnings -fPIC -I. -I"$include" -c behind.cpp
fi
warnings="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Werror"
echo '#include <indurop/generated.c.h>' >module.c
# shellcheck disable=SC2086
quiet gcc -std=c11 $warnings -fPIC -I. -I"$include" -c module.c
if command -v clang-14 >/dev/null; then
  # shellcheck disable=SC2086
  quiet clang-14 -std=c11 $warnings -fPIC -I. -I"$include" -c module.c
fi
