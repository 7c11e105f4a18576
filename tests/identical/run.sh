#!/usr/bin/env bash
# Runs one scene program for each instruction set and compares the hashes that they print. Every instruction set other
# than the first counts as one test: passed when it prints the same as the first. One that this machine cannot execute is
# named and not counted.
#
# Usage: tests/identical/run.sh COUNT_FILE FOLDER NAME...      FOLDER holds one program per NAME; `aarch64` runs under
# qemu-aarch64 on any other machine. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all are the same.
set -euo pipefail

count_file=$1 folder=$2
shift 2
illegal_instruction=132  # 128 + SIGILL

run() {
  if [[ $1 == aarch64 && $(uname -m) != aarch64 ]]; then qemu-aarch64 "$folder/$1"; else "$folder/$1"; fi
}

first=$1 passed=0 failed=0
wanted=$(run "$first") || { echo "the program for '$first' failed:"$'\n'"$wanted" && failed=1; }
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
