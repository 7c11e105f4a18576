#!/usr/bin/env bash
# Compiles every file of this folder. A file with a line `// expected: MESSAGE` must be refused with that message among
# the compiler's; a file without one is a control and must compile, so that the others fail for their own reason.
#
# Usage: tests/compile_fail/run.sh COUNT_FILE CXX FLAGS...
# Writes "PASSED FAILED" to COUNT_FILE and prints one line for each failure. Exit code: 0 when all is as it should be.
set -euo pipefail

count_file=$1
shift
command=("$@" -fno-exceptions -fno-rtti -fsyntax-only)  # the kernel must do without either
folder=$(dirname "$0")
results=$(mktemp)
trap 'rm -f "$results"' EXIT

# Appends "ok NAME" or "FAILED NAME: why" to the results.
compile() {
  local file=$1 name=${1##*/} expected output code=0
  expected=$(sed -n 's|^// expected: ||p' "$file")
  output=$(LC_ALL=C "${command[@]}" "$file" 2>&1) || code=$?
  output=${output//\\/}  # clang escapes quotes in messages
  if [[ -z $expected ]]; then
    if ((code == 0)); then echo "ok $name"; else echo "FAILED $name: it must compile, and does not:"$'\n'"$output"; fi
  elif ((code == 0)); then
    echo "FAILED $name: it compiles, and must not"
  elif [[ $output != *"$expected"* ]]; then
    echo "FAILED $name: the message '$expected' is not among:"$'\n'"$output"
  else
    echo "ok $name"
  fi
}

cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
running=0
for file in "$folder"/*.cpp; do
  compile "$file" >>"$results" &
  if ((++running >= cores)); then wait -n && ((running--)); fi
done
wait

passed=$(grep -c '^ok ' "$results" || true)
failed=$(grep -c '^FAILED ' "$results" || true)
grep -v '^ok ' "$results" || true
printf 'tests/%-28s %3d passed, %d failed\n' compile_fail/ "$passed" "$failed"
echo "$passed $failed" >"$count_file"
((failed == 0 && passed > 1))
