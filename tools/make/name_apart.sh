#!/usr/bin/env bash
# A name for a path that no other path shares: NAME-HASH, the path's last part without .toml and the beginning of a hash
# of the whole path. What lies in the folder KNOWN keeps its plain NAME. Cases elsewhere get their folders so: of what is
# built for them, and of their results.
#
# Usage: tools/make/name_apart.sh PATH [KNOWN]      Paths are made absolute and rid of . and .. by their text alone: what
# is not there yet has a name, and keeps it.
set -euo pipefail

absolute() {
  local path=$1 part parts=() kept=()
  [[ $path == /* ]] || path=$PWD/$path
  IFS=/ read -r -d '' -a parts < <(printf '%s\0' "$path")
  for part in "${parts[@]}"; do
    case $part in
      '' | .) ;;
      ..) ((${#kept[@]} == 0)) || unset "kept[-1]" ;;
      *) kept+=("$part") ;;
    esac
  done
  printf '/%s' "${kept[@]}"
}

path=$(absolute "$1")
name=$(basename "$path" .toml)
if [[ $# -gt 1 && ${path%/*} == "$(absolute "$2")" ]]; then
  echo "$name"
else
  hash=$(printf '%s' "$path" | { sha256sum 2>/dev/null || shasum -a 256; })
  echo "${name//[^A-Za-z0-9._+-]/_}-${hash:0:10}"  # a folder on the way may have any name
fi
