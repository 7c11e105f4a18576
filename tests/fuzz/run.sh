#!/usr/bin/env bash
# Runs the fuzzers one after the other, each for its share of the time, and says for each how many inputs it tried and what
# it found. New inputs that reach new code go to FOLDER/TARGET/corpus and are used again the next time. A finding is also
# an input that takes more than a second of processor time or 1 GB: libFuzzer keeps those that took a second by the clock, and
# they are timed once more here, because a busy machine makes them take longer.
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
  options=(-max_len=8192)
  if [[ $target == case ]]; then
    seeds+=(cases)
    sed -n 's/^| `\([a-z_]*\)`.*/"\1"/p' cases/README.md | sort -u >"$own/dictionary"
    printf '"%s"\n' particles species sizes material contact pipe feed gas start particle run capacity output probe '[' ']' '[[' ']]' ' = ' '\x0a' '[[0, 1], [2, 3]]' \
      inf nan 1e-300 1e300 5e-324 true '\"\"\"' >>"$own/dictionary"
    options=(-max_len=65536 -dict="$own/dictionary")
  fi
  rm -f "$own"/slow-unit-*
  code=0
  "$folder/bin/$target" -max_total_time=$((seconds / $#)) -timeout=20 -report_slow_units=1 -rss_limit_mb=1024 "${options[@]}" -print_final_stats=1 \
    -artifact_prefix="$own/" "$own/corpus" "${seeds[@]}" >"$own/log.txt" 2>&1 || code=$?
  for slow in "$own"/slow-unit-*; do
    if [[ -e $slow ]] && ! (ulimit -t 1 && exec "$folder/bin/$target" "$slow") >>"$own/log.txt" 2>&1; then
      echo "$slow: more than a second of processor time" >>"$own/log.txt"
      code=1
    fi
  done
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
