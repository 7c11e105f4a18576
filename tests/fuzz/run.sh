#!/usr/bin/env bash
# Runs the fuzzers one after the other, each for its share of the time, and says for each how many inputs it tried and what
# it found. New inputs that reach new code go to FOLDER/TARGET/corpus and are used again the next time.
#
# Usage: tests/fuzz/run.sh FOLDER SECONDS TARGET...      Exit code: 0 when nothing was found, 1 otherwise.
set -euo pipefail

folder=$1 seconds=$2
shift 2
failed=0
for target in "$@"; do
  own=$folder/$target
  mkdir -p "$own/corpus"
  seeds=(tests/corpus/"$target")
  if [[ $target == case ]]; then seeds+=(cases); fi
  code=0
  "$folder/bin/$target" -max_total_time=$((seconds / $#)) -timeout=20 -rss_limit_mb=2048 -max_len=8192 -print_final_stats=1 \
    -artifact_prefix="$own/" "$own/corpus" "${seeds[@]}" >"$own/log.txt" 2>&1 || code=$?
  inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$own/log.txt")
  if ((code == 0)); then
    echo "fuzz $target: ${inputs:-0} inputs, nothing found"
  else
    tail -n 40 "$own/log.txt"
    echo "fuzz $target: found something after ${inputs:-?} inputs; the input is in $own/, replay it with $folder/bin/$target FILE"
    failed=1
  fi
done
exit $failed
