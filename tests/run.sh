#!/usr/bin/env bash
# Runs the test program, one process per source file and as many at a time as there are cores, then the files that must
# not compile, the freestanding and the stripped scene, the scenes that must be identical, the tests of tools/peers and the quick form of make
# stability; ends with one line, `N passed, M failed`. The output of a source file is shown when something in it fails.
#
# Usage: tests/run.sh BUILD_FOLDER CXX FLAGS...      Exit code: 0 when all passed, 1 otherwise.
# Environment: IDENTICAL, names of the programs in BUILD_FOLDER/identical that are compared, separated by
# blanks; none: they are left out.
# Environment: IDENTICAL, names of the programs in BUILD_FOLDER/identical that are compared, separated by blanks; FRONTIER,
# folder of the programs of `make frontier QUICK=1`, or nothing.
set -euo pipefail

build=$1
shift
export build
cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
reports=$build/test-reports
rm -rf "$reports"
mkdir -p "$reports"
export reports

# One source file: its test cases counted from doctest's own summary; a crash counts as one failure.
run_file() {
  local name=$1 report=$reports/$1.txt started=$SECONDS code=0 passed failed
  "$build/tests" --source-file="*/$name.cpp,$name.cpp" --no-intro --no-path-filenames >"$report" 2>&1 || code=$?
  read -r passed failed < <(sed -n 's/^\[doctest\] test cases: *[0-9]* | *\([0-9]*\) passed | *\([0-9]*\) failed.*/\1 \2/p' "$report") ||
    { passed=0 failed=1 && echo "no summary: the test program ended with code $code" >>"$report"; }
  if ((code != 0 && failed == 0)); then failed=1; fi
  if ((failed > 0)); then cat "$report"; fi
  printf 'tests/%-28s %3d passed, %d failed (%d s)\n' "$name.cpp" "$passed" "$failed" $((SECONDS - started))
  echo "$passed $failed" >"$reports/$name.count"
}
export -f run_file

grep -lE '^ *(TEST_CASE|TEST_SUITE|SCENARIO)' tests/*.cpp | xargs -n 1 basename | sed 's/\.cpp$//' |
  xargs -P "$cores" -I '{}' bash -c 'run_file {}'

# No test case may be lost on the way from the program to the sum.
counted=$(cat "$reports"/*.count | awk '{ sum += $1 + $2 } END { print sum + 0 }')
known=$("$build/tests" --count | sed -n 's/.*filters: *//p')
if [[ $counted != "$known" ]]; then
  echo "tests/run.sh: the program knows $known test cases, and $counted were run"
  echo "0 1" >"$reports/lost.count"
fi

tests/compile_fail/run.sh "$reports/compile_fail.count" "$@" || true
echo "0 1" >"$reports/freestanding.count"  # if it ends before it counts
tests/freestanding_test.py "$reports/freestanding.count" "$build/freestanding" "$@" >"$reports/freestanding.txt" 2>&1 ||
  cat "$reports/freestanding.txt"
printf 'tests/%-28s %3d passed, %d failed\n' freestanding_test.py $(cat "$reports/freestanding.count")
echo "0 1" >"$reports/footprint.count"
tests/footprint_test.py "$reports/footprint.count" "$build/footprint-test" "$@" >"$reports/footprint.txt" 2>&1 ||
  cat "$reports/footprint.txt"
printf 'tests/%-28s %3d passed, %d failed\n' footprint_test.py $(cat "$reports/footprint.count")
[[ -z $IDENTICAL ]] || tests/identical/run.sh "$reports/identical.count" "$build/identical" '' $IDENTICAL || true

echo "0 1" >"$reports/peers.count"  # if it ends before it counts
tests/peers_test.py "$reports/peers.count" >"$reports/peers.txt" 2>&1 || cat "$reports/peers.txt"
printf 'tests/%-28s %3d passed, %d failed\n' peers_test.py $(cat "$reports/peers.count")

# Limits of the time step and extreme scenes of `settle`: the quick form of make stability.
echo "0 1" >"$reports/stability.count"
"$build/bin/settle" --out "$build/stability/settle/run" --quiet --no-frames >"$reports/stability.txt" 2>&1 &&
  tools/stability/stability.py --quick --case-file cases/settle.toml --casegen "$build/casegen" --folder "$build/stability/settle" \
    --results "$build/stability/settle/run" --out "$build/stability/settle/page" --jobs "$cores" --count "$reports/stability.count" \
    >>"$reports/stability.txt" 2>&1 || cat "$reports/stability.txt"
printf 'tests/%-28s %3d passed, %d failed\n' 'make stability QUICK=1' $(cat "$reports/stability.count")
if [[ -n ${FRONTIER:-} ]]; then  # the quick form of make frontier, and what it must have found
  echo "0 1" >"$reports/frontier.count"
  { tools/frontier/frontier.py --quick --programs "$FRONTIER" --case settle --header "$build/cases/settle.hpp" \
    --state "$FRONTIER/run/final.fixdem" --out "$FRONTIER/report" --jobs "$cores" &&
    tests/frontier_test.py "$FRONTIER" "$reports/frontier.count"; } >"$reports/frontier.txt" 2>&1 || cat "$reports/frontier.txt"
  printf 'tests/%-28s %3d passed, %d failed\n' frontier_test.py $(cat "$reports/frontier.count")
fi

cat "$reports"/*.count | awk '{ passed += $1; failed += $2 } END { print passed + 0 " passed, " failed + 0 " failed"; exit passed == 0 || failed > 0 }'
