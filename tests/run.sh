#!/usr/bin/env bash
# Runs the test program, one process per source file and as many at a time as there are cores, then the files that must
# not compile, the freestanding and the stripped scene, the tests of programs in Python, the live picture and the quick
# forms of make stability and make frontier; ends with one line, `N passed, M failed`. The output of a source file is
# shown when something in it fails.
#
# Usage: tests/run.sh BUILD_FOLDER CXX FLAGS...      Exit code: 0 when all passed, 1 otherwise.
# Environment: FRONTIER, folder of the programs of `make frontier QUICK=1`; KILLS, how often tests/kill_test.py kills; SWEEP_PYTHON,
# the python3 of tests/sweep/sweep_test.py. What is empty is left out. NUMPY_PYTHON: a python3 with NumPy, where there is one, for
# tests/python_reader_test.py. PROGRAM_ONLY, not empty: the test program alone.
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

finish() {
  cat "$reports"/*.count | awk '{ passed += $1; failed += $2 } END { print passed + 0 " passed, " failed + 0 " failed"; exit passed == 0 || failed > 0 }'
}
if [[ -n ${PROGRAM_ONLY:-} ]]; then
  finish
  exit
fi

tests/compile_fail/run.sh "$reports/compile_fail.count" "$@" || true

# A test that is a program of its own: name, then the command, which writes what it counted to reports/NAME.count.
run_part() {
  local name=$1
  shift
  echo "0 1" >"$reports/$name.count"  # if it ends before it counts
  "$@" >"$reports/$name.txt" 2>&1 || cat "$reports/$name.txt"
  printf 'tests/%-28s %3d passed, %d failed\n' "$name" $(cat "$reports/$name.count")
}
quick_stability() {
  local folder=$build/stability/settle
  "$build/bin/settle" --out "$folder/run" --replace --quiet --no-frames &&
    tools/stability/stability.py --quick --case-file cases/settle.toml --casegen "$build/casegen" --folder "$folder" \
      --results "$folder/run" --out "$folder/page" --jobs "$cores" --count "$reports/quick_stability.count"
}
quick_frontier() {
  tools/frontier/frontier.py --quick --programs "$FRONTIER" --case settle --header "$build/cases/settle.hpp" \
    --state "$FRONTIER/run/final.fixdem" --out "$FRONTIER/report" --jobs "$cores" &&
    tests/frontier_test.py "$FRONTIER" "$reports/quick_frontier.count"
}
run_part counted_test.py tests/counted_test.py "$reports/counted_test.py.count"
run_part freestanding_test.py tests/freestanding_test.py "$reports/freestanding_test.py.count" "$build/freestanding" "$@"
run_part footprint_test.py tests/footprint_test.py "$reports/footprint_test.py.count" "$build/footprint-test" "$@"
run_part peers_test.py tests/peers_test.py "$reports/peers_test.py.count"
run_part scaling_test.py tests/scaling_test.py "$reports/scaling_test.py.count"
run_part results_test.py tests/results_test.py "$build" "$reports/results_test.py.count"
run_part kept_run_test.py tests/kept_run_test.py "$reports/kept_run_test.py.count"
run_part line_files_test.py tests/line_files_test.py "$reports/line_files_test.py.count"
numpy_python=${NUMPY_PYTHON:-python3}
"$numpy_python" -c 'import numpy' 2>/dev/null || numpy_python=python3
run_part python_files_test.py tests/python_files_test.py "$reports/python_files_test.py.count"
run_part python_reader_test.py "$numpy_python" tests/python_reader_test.py "$reports/python_reader_test.py.count"
sed -n '/are skipped$/s/^/  /p' "$reports/python_reader_test.py.txt"
run_part validate_contacts_test.py tests/validate_contacts_test.py "$reports/validate_contacts_test.py.count"
run_part project_test.py tests/project_test.py "$build" "$reports/project_test.py.count"
run_part validate_test.py tests/validate_test.py "$build" "$reports/validate_test.py.count"
run_part make_test.py tests/make_test.py "$build" "$1" "$build/scratch/make" "$reports/make_test.py.count"
run_part make_input_test.py tests/make_input_test.py "$build" "$1" "$build/scratch/make input" "$reports/make_input_test.py.count"
run_part systems_test.py tests/systems/systems_test.py "$reports/systems_test.py.count"
run_part lammps_files_test.py tests/lammps_files_test.py "$build" "$reports/lammps_files_test.py.count"
run_part lammps_sizes_test.py tests/lammps_sizes_test.py "$build" "$reports/lammps_sizes_test.py.count"
[[ -z ${KILLS:-} ]] || run_part kill_test.py tests/kill_test.py "$build/bin" "$build/scratch/kill" --kills "$KILLS" \
  --count "$reports/kill_test.py.count"
[[ -z ${SWEEP_PYTHON:-} ]] || run_part sweep_test.py "$SWEEP_PYTHON" tests/sweep/sweep_test.py "$build/casegen" "$build/scratch/sweep" \
  "$reports/sweep_test.py.count"
run_part watch_test.py tests/watch_test.py "$build/bin/settle" "$build/scratch/watch" "$reports/watch_test.py.count"
run_part quick_stability quick_stability
[[ -z ${FRONTIER:-} ]] || run_part quick_frontier quick_frontier

finish
