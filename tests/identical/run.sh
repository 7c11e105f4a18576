#!/usr/bin/env bash
# Runs one scene program for each instruction set and compares the hashes that they print. Every instruction set other
# than the first counts as one test: passed when it prints the same as the first. One that this machine cannot execute is
# named and not counted.
#
# Usage: tests/identical/run.sh COUNT_FILE FOLDER ARGUMENT [FILE.txt] NAME...      FOLDER holds one program per NAME, each is
# run with ARGUMENT unless that is empty; FILE.txt is what all must print, without it the first is compared with; `aarch64` runs under qemu-aarch64 on any other machine, `cortex-m7` on an emulated board.
# Lines that begin with # are not compared. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all are the same.
set -euo pipefail

count_file=$1 folder=$2 argument=$3
shift 3
illegal_instruction=132  # 128 + SIGILL

run() {
  local on=()
  if [[ $1 == cortex-m7 ]]; then on=(tools/embedded/run.sh); fi
  if [[ $1 == aarch64 && $(uname -m) != aarch64 ]]; then on=(qemu-aarch64); fi
  "${on[@]}" "$folder/$1" $argument | sed '/^#/d'
}

first=$1 passed=0 failed=0
if [[ $first == *.txt ]]; then run_first=(cat); else run_first=(run); fi
wanted=$("${run_first[@]}" "$first") || { echo "the program for '$first' failed:"$'\n'"$wanted" && failed=1; }
for name in "${@:2}"; do
  code=0
  found=$(run "$name" 2>&1) || code=$?
  if ((code == illegal_instruction)); then
    echo "tests/identical: $name is compiled, and this machine has no such instructions to run it"
  elif ((code == 0)) && [[ $found == "$wanted" ]]; then
    ((++passed))
  else
    printf 'tests/identical: %s (exit code %d) differs from %s:\n' "$name" "$code" "$first"
    diff <(echo "$wanted") <(echo "$found") || true
    ((++failed))
  fi
done
printf 'tests/%-28s %3d passed, %d failed (%s)\n' identical/ "$passed" "$failed" "$*"
echo "$passed $failed" >"$count_file"
((failed == 0 && passed > 0))
