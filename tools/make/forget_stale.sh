#!/usr/bin/env bash
# Removes from a build folder what was made of other sources, by another compiler, or with other options than those of now.
#
# make goes by time stamps, and a file that is put in place of another (mv, cp -p, rsync -a, a folder renamed) may be older
# than what was made of the other one. So the build folder holds the hashes of all sources as they were when it was last looked
# at (sources.sha256), and each variant in it what compiled it (made_by). What the notes of the compiler (*.d) say was made of a
# file whose hash is another one now is removed; make then makes it again. Case files are not among the sources: casegen
# reads them each time.
#
# Usage: tools/make/forget_stale.sh BUILD VARIANT_FOLDER      Prints `done`, or nothing while there is no compiler yet.
# Environment: COMPILER, the command; FLAGS, all options of programs; TEST_FLAGS, those that concern tests alone.
set -euo pipefail
export LC_ALL=C

build=$1 variant=$2
seen=$build/sources.sha256 made_by=$variant/made_by made_for=$variant/tests_made_for
mkdir -p "$build"
if command -v flock >/dev/null; then
  exec 9>>"$build/.lock"
  flock 9
fi
sums() { if command -v sha256sum >/dev/null; then sha256sum "$@"; else shasum -a 256 "$@"; fi; }
export -f sums

# All folders of this name but those among objects, packages of npm and roots of other systems.
forget_folders() { find "$build" \( -name objects -o -name node -o -name instrumented -o -name systems \) -prune -o -type d -name "$1" -prune -exec rm -rf {} +; }

# Targets in the compiler's notes that were made of a file in $1, one per line there.
made_of() {
  find "$build" \( -name node -o -name systems \) -prune -o -name '*.d' -print0 | CHANGED=$1 xargs -0 -r awk '
    BEGIN { split(ENVIRON["CHANGED"], names, "\n"); for (i in names) changed[names[i]] }
    {
      goes_on = sub(/\\$/, "")
      for (i = 1; i <= NF; ++i)
        if ($i ~ /:$/) target = substr($i, 1, length($i) - 1)
        else if (target != "" && $i in changed) { print target; target = "" }
      if (!goes_on) target = ""
    }'
}

forget() {
  local changed=$1 name
  while read -r name; do
    case $name in
      tools/make/rules.mk) ;;  # its commands are part of made_by
      tools/make/embedded.mk | *.ld) forget_folders embedded && forget_folders identical ;;
      tools/make/*.mk) forget_folders "$(basename "$name" .mk)" ;;
      tools/peers/*) forget_folders peers ;;
      tools/run_report/*) rm -rf "$build"/node/page ;;
      tests/precompiled.hpp) forget_folders precompiled ;;
    esac
    case $name in *.hpp | *.cpp) forget_folders tidy && forget_folders checked ;; esac
    # What a file that is gone was linked into has no note of it.
    if [[ $name == *.cpp && ! -e $name ]]; then
      find "$build" -mindepth 2 -maxdepth 2 ! -path "$build/node/*" ! -path "$build/instrumented/*" ! -path "$build/systems/*" ! -name objects ! -name made_by -exec rm -rf {} +
    fi
  done <<<"$changed"
  made_of "$changed" | sort -u | tr '\n' '\0' | xargs -0 -r rm -f
}

now=$(find kernel tools tests bench -name __pycache__ -prune -o -path tests/corpus -prune -o -type f ! -name '*.md' ! -name '*.svg' \
  ! -name '*.png' ! -name '*.csv' -print0 | xargs -0 bash -c 'sums "$@"' - | sort)
if [[ -e $seen ]]; then
  changed=$(comm -23 "$seen" - <<<"$now" | cut -c67-)
  [[ -z $changed ]] || forget "$changed"
else
  rm -f "$build"/*/made_by  # of sources that nobody knows
fi
printf '%s\n' "$now" >"$seen.$$"
mv -f "$seen.$$" "$seen"

# The compiler's version, and what -march=native stands for on this machine; versions of the libraries that are compiled in.
# Where it looks for headers is left out: it says which of the folders are there, and ours is not at first. clang names the
# present folder, too, in quotes if it has a blank: a checkout may be moved.
options=$(sed -E 's/-(I|isystem) ?[^ ]+//g' <<<"$FLAGS")
said=$($COMPILER $options -v -dM -E -x c++ /dev/null 2>&1 | grep -v ' /tmp/' | tr -d '"') || exit 0
identity=$(sums <<<"${said//"$PWD"/.}")
found() {
  local header folder
  for header in "$@"; do
    for folder in /usr/include /usr/local/include /opt/homebrew/include; do
      [[ ! -e $folder/$header ]] || echo "$folder/$header"
    done
  done
}
mapfile -t libraries < <(found fmt/{base,core,format}.h toml++/{toml.h,impl/version.h} CLI/Version.hpp nlohmann/detail/abi_macros.hpp nlohmann/json.hpp xxhash.h)
# They may be about to be installed (tools/deps); then there is nothing made with others yet.
for name in fmt toml++ CLI nlohmann xxhash; do
  [[ -e $variant || ${libraries[*]} == *"/$name"* ]] || exit 0
done
((${#libraries[@]} == 0)) || identity+=$'\n'$(sums "${libraries[@]}")
mapfile -t libraries < <(found doctest/doctest.h boost/version.hpp)
((${#libraries[@]} == 0)) || TEST_FLAGS+=$'\n'$(sums "${libraries[@]}")
identity+=$'\n'$COMPILER$'\n'$FLAGS$'\n'$LIBRARIES$'\n'$(grep -E 'CXX|_flags|libraries|defines|checksum|^(kept|linked|object) ' tools/make/rules.mk | sums)
replace() { [[ -e $1 && $(<"$1") == "$2" ]] || { printf '%s\n' "$2" >"$1.$$" && mv -f "$1.$$" "$1"; }; }
if [[ -e $variant && ! ( -e $made_by && $(<"$made_by") == "$identity" ) ]]; then
  echo "fixdem: what is in $variant was made by another compiler, with other options or of unknown sources: it is made anew" >&2
  rm -rf "$variant"
fi
mkdir -p "$variant"
if [[ -e $made_for && $(<"$made_for") != "$TEST_FLAGS" ]]; then
  rm -rf "$variant"/{tests,objects/tests,precompiled}
fi
replace "$made_by" "$identity"
replace "$made_for" "$TEST_FLAGS"
echo 'done'
