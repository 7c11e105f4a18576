#!/usr/bin/env bash
# The mark of a whole run: which program and which start state gave which final state, by their contents. A case that starts
# from that final state can take it while all three are still the same; time stamps would also believe a file that was put
# in the place of another one.
#
# Usage: whole_run.sh inputs PROGRAM [START]            prints what is written down before the run
#        whole_run.sh leave MARK INPUTS STATE           writes the mark after it
#        whole_run.sh holds MARK STATE PROGRAM [START]  exit code 0 when STATE is the final state of that run, 1 otherwise
set -euo pipefail

contents() { { sha256sum -- "$@" 2>/dev/null || shasum -a 256 -- "$@"; } | cut -d' ' -f1; }

what=$1
shift
case $what in
  inputs) contents "$@" ;;
  leave)
    printf '%s\n%s\n' "$2" "$(contents "$3")" >"$1.$$"
    mv -f "$1.$$" "$1"
    ;;
  holds)
    mark=$1 state=$2
    shift 2
    [[ -e $mark && -e $state && $(<"$mark") == "$(contents "$@")"$'\n'"$(contents "$state")" ]]
    ;;
esac
