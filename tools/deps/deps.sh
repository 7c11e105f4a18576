#!/usr/bin/env bash
# Finds what the named groups of targets need (tools/deps/needs.txt) and installs what is missing, with the system's own
# package manager, through sudo when not root. Says nothing and touches nothing when all is there.
#
# Usage: tools/deps/deps.sh GROUP...      groups: run, test, identical, embedded, footprint, bench, report, peers, lammps,
# lammps-library, mpi, export, check, table, page, browser, figures, movie, picture, render, sweep, slurm, clusters,
# systems
# Environment: CXX (the compiler to probe; default g++), INCLUDES (its -isystem flags).
# Exit code: 0 all there now, 1 something is still missing.
set -euo pipefail

CXX=${CXX:-g++}
INCLUDES=${INCLUDES:--isystem /usr/include/eigen3}
needs=$(dirname "$0")/needs.txt

# Prints the probes of the given groups that fail, one per line.
missing_probes() {
  local group probe rest headers=""
  while read -r group probe rest; do
    [[ " $* " == *" $group "* ]] || continue
    case $probe in
      "<"*) headers+=$probe$'\n' ;;
      CXX) command -v "${CXX%% *}" >/dev/null && compiles || echo CXX ;;
      /*) [[ -e $probe ]] || echo "$probe" ;;
      module:*) has_module "${probe#module:}" || echo "$probe" ;;
      *) command -v "$probe" >/dev/null || echo "$probe" ;;
    esac
  done <"$needs"
  [[ -z $headers ]] || missing_headers <<<"${headers%$'\n'}"
}

# A module of Python, for the first python3 of the path or for the system's own, which packages bring it to.
has_module() { python3 -c "import $1" 2>/dev/null || /usr/bin/python3 -c "import $1" 2>/dev/null; }

# A compiler without the C library's headers or without C++20 is as good as none.
compiles() { $CXX -std=c++20 -fsyntax-only -x c++ - <<<'#include <cstdio>' 2>/dev/null; }

# Asks the compiler itself which of the headers on standard input it would find, all in one go.
missing_headers() {
  local list
  list=$(cat)
  if ! command -v "${CXX%% *}" >/dev/null; then
    echo "$list"
    return
  fi
  while read -r header; do printf '#if !__has_include(%s)\nMISSING %s\n#endif\n' "$header" "$header"; done <<<"$list" |
    $CXX -std=c++20 $INCLUDES -E -P -x c++ - 2>/dev/null | sed -n 's/^MISSING //p' | tr -d ' '
}

# The package that brings a probe, from the column of the package manager.
package_of() {
  local probe=$1 column=$2 compiler=${CXX##*/}
  if [[ $probe == CXX && $column == 3 ]]; then
    echo "${compiler/clang++/clang}"  # g++, g++-13, clang++-16: Debian names the package after the command
  elif [[ $probe == CXX && $compiler == clang* ]]; then
    [[ $column == 6 ]] && echo llvm || echo clang
  else
    awk -v probe="$probe" -v column="$column" '$1 !~ /^#/ && $2 == probe { print $column; exit }' "$needs"
  fi
}

mapfile -t missing < <(missing_probes "$@")
((${#missing[@]})) || exit 0
names=$(printf '%s\n' "${missing[@]}" | sed "s|^CXX\$|$CXX (C++20)|" | paste -sd ' ')

as_root=()
if ((EUID != 0)); then as_root=(sudo); fi
for manager in apt-get dnf pacman brew none; do command -v $manager >/dev/null && break; done
column=3
case $manager in
  apt-get)  # another installation may be under way: wait for it
    column=3 update=(apt-get update -q)
    install=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 install -q -y --no-install-recommends) ;;
  dnf) column=4 update=(true) install=(dnf install -y) ;;
  pacman) column=5 update=(true) install=(pacman -Sy --needed --noconfirm) ;;
  brew) column=6 update=(true) install=(brew install) as_root=() ;;
esac
mapfile -t packages < <(for probe in "${missing[@]}"; do package_of "$probe" $column; done | grep -vx -e - | sort -u)

if [[ $manager == none ]] || { ((${#as_root[@]})) && ! command -v sudo >/dev/null; }; then
  {
    echo "fixdem: missing: $names"
    if [[ $manager == none ]]; then
      echo "  no apt-get, dnf, pacman or brew here: install these by hand (names of the Debian packages): ${packages[*]}"
    else
      echo "  neither root nor sudo: run as root:  ${install[*]} ${packages[*]}"
    fi
  } >&2
  exit 1
fi

echo "fixdem: missing: $names; installing with $manager: ${packages[*]}" >&2
"${as_root[@]}" "${update[@]}" >&2 || echo "fixdem: '${update[*]}' failed; trying to install all the same" >&2
"${as_root[@]}" "${install[@]}" "${packages[@]}" >&2 || true

hash -r
mapfile -t missing < <(missing_probes "$@")
((${#missing[@]})) || exit 0
echo "fixdem: still missing after the installation: ${missing[*]} (see the messages above)" >&2
exit 1
