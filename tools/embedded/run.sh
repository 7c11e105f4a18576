#!/usr/bin/env bash
# Runs a program on an emulated board (MPS2 with the Cortex-M7 of Arm's AN500) and says what it took of the board's memory.
#
# Usage: tools/embedded/run.sh PROGRAM [ARGUMENT...]      PROGRAM.memory: what the linker said. Lines that are not the
# program's begin with #. Exit code: the program's.
set -euo pipefail

program=$1
shift
started=$SECONDS code=0
words=arg=$(basename "$program")
for word in "$@"; do words+=,arg=$word; done
qemu-system-arm -M mps2-an500 -display none -monitor none -serial null -chardev stdio,id=answers \
  -semihosting-config enable=on,target=native,chardev=answers,"$words" -kernel "$program" </dev/null || code=$?
awk '/FLASH|RAM/ { print "# " $1 " " $2 " " $3 " used of " $4 " " $5 " (" $6 ")" }' "$program.memory"
echo "# emulated in $((SECONDS - started)) s"
exit $code
