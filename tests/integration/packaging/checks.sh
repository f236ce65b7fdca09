# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# For scripts that prove something step by step, which source it: check() runs a command, with its output in $work, and counts in
# $failures what is wrong.
failures=0

check() { # TEXT COMMAND...
  text=$1
  shift
  if "$@" >"$work/check.log" 2>&1; then
    echo "ok    $text"
  else
    echo "WRONG $text"
    cat "$work/check.log"
    failures=$((failures + 1))
  fi
}
