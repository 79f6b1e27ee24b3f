#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The unit tests under ThreadSanitizer: core/testing/races.sh [CTEST OPTIONS]
#
# Debian's TBB does not tell the sanitizer where its loops begin and end, so that all that one loop
# writes and the next reads would count as a race. Hence a TBB of its own from Debian's source;
# Embree, which stays Debian's, is not looked at.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
build=$root/build/races
tbb=$build/onetbb
export PATH=/usr/sbin:/usr/bin:/sbin:/bin

fetch_tbb() {
  local apt=$build/apt
  mkdir -p "$tbb" "$apt/lists/partial"
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]" \
    "http://deb.debian.org/debian bookworm main" > "$apt/sources.list"
  local options=(-o "Dir::Etc::sourcelist=$apt/sources.list" -o Dir::Etc::sourceparts=-
    -o "Dir::State::lists=$apt/lists" -o "Dir::Cache=$apt" -o APT::Sandbox::User=root)
  apt-get -q "${options[@]}" update
  (cd "$apt" && apt-get -q "${options[@]}" --download-only source onetbb)
  tar -xf "$apt"/onetbb_*.orig.tar.xz -C "$tbb" --strip-components=1
}

if [[ ! -e $tbb/build/done ]]; then
  fetch_tbb
  cmake -S "$tbb" -B "$tbb/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTBB_TEST=OFF \
    -DTBB_STRICT=OFF -DCMAKE_CXX_FLAGS="-fsanitize=thread -g1"
  ninja -C "$tbb/build" tbb
  touch "$tbb/build/done"
fi

cmake -S "$root" -B "$build/core" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSANITIZE=thread \
  -DTENNIEL_SCRIPTS_DIR="$build/scripts" -DBUILD_TESTING=ON
LD_LIBRARY_PATH=$(dirname "$(find "$tbb/build" -name libtbb.so.12)")
export LD_LIBRARY_PATH
export TSAN_OPTIONS="suppressions=$root/core/testing/races.supp ignore_noninstrumented_modules=1"
ninja -C "$build/core" unit_tests
ctest --test-dir "$build/core" -L '^unit$' --output-on-failure -j2 "$@"
