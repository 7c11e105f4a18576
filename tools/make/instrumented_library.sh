#!/usr/bin/env bash
# Builds the standard library of clang (libc++) with the memory sanitizer, from the source of the clang++ installed here:
# with a library that is not built so, every value that it writes would count as never written (make test SAN=memory).
#
# Usage: tools/make/instrumented_library.sh FOLDER      FOLDER/include/c++/v1 and FOLDER/lib/libc++.a; the source of
# LLVM is fetched by apt (130 MB) and deleted afterwards. Exit code: 0 done, 1 it could not be built, and why.
set -euo pipefail

folder=$(realpath -m "$1")
version=$(clang++ -dumpversion)
package=clang-${version%%.*}
if ! command -v apt-get >/dev/null || ! origin=$(apt-cache madison "$package" 2>/dev/null | head -1) || [[ -z $origin ]]; then
  echo "fixdem: the source of clang++ $version is fetched by apt, which knows no package $package here; build its libc++" \
    "with LLVM_USE_SANITIZER=Memory and say where: make test SAN=memory CXX=clang++ INSTRUMENTED=folder" >&2
  exit 1
fi

# Only the archive that this clang comes from, with lists of our own, so that nothing of the system's is touched.
rm -rf "$folder"
mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache"
read -r _ _ _ _ site suite _ <<<"$origin"  # clang-14 | 1:14.0.6-12 | http://deb.debian.org/debian bookworm/main amd64 Packages
echo "deb-src $site ${suite%%/*} ${suite#*/}" >"$folder/apt/sources.list"
fetch=(apt-get -q -o "Dir::Etc::sourcelist=$folder/apt/sources.list" -o Dir::Etc::sourceparts=/dev/null
  -o "Dir::State::lists=$folder/apt/lists" -o "Dir::Cache=$folder/apt/cache" -o APT::Sandbox::User=root)
"${fetch[@]}" update >&2
source_name=$(dpkg-query -W -f '${source:Package}' "$package")
(cd "$folder/apt" && "${fetch[@]}" --download-only source "$source_name" >&2)
tar -C "$folder/apt" -xf "$folder"/apt/"$source_name"_*.orig.tar.* --wildcards '*/libcxx' '*/libcxxabi' '*/runtimes' '*/cmake' '*/llvm/CMakeLists.txt'

cmake -G Ninja -S "$folder"/apt/llvm*/runtimes -B "$folder" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang \
  -DCMAKE_CXX_COMPILER=clang++ -DLLVM_ENABLE_RUNTIMES='libcxx;libcxxabi' -DLLVM_USE_SANITIZER=Memory -DLLVM_INCLUDE_TESTS=OFF \
  -DLIBCXX_ENABLE_SHARED=OFF -DLIBCXXABI_ENABLE_SHARED=OFF -DLIBCXX_ENABLE_STATIC_ABI_LIBRARY=ON -DLIBCXXABI_USE_LLVM_UNWINDER=OFF \
  -DLIBCXX_INCLUDE_TESTS=OFF -DLIBCXX_INCLUDE_BENCHMARKS=OFF -DLIBCXXABI_INCLUDE_TESTS=OFF >"$folder/build.log"
ninja -C "$folder" cxx cxxabi >>"$folder/build.log" || { tail -n 30 "$folder/build.log" >&2; exit 1; }
rm -rf "$folder/apt"
