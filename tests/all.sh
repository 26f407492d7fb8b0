#!/usr/bin/env bash
# What `./run test --all` adds: every test under sanitizers (built by Clang), ten minutes of fuzzing, and everything in
# ../shared/data baked, verified and streamed. Expects build/release.
set -euo pipefail
cd "$(dirname "$0")/.."
fuzz_seconds=${FUZZ_SECONDS:-600}

say() { printf '\033[1m%s\033[0m\n' "$*" >&2; }

configure_and_build() { # FOLDER options...
  local folder=$1
  shift
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang-19 -DCMAKE_CXX_COMPILER=clang++-19 \
    -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DLIGHTWELL_WERROR=ON "$@" >"$folder.log" 2>&1 || { cat "$folder.log" >&2; exit 1; }
  ninja -C "$folder" --quiet >&2
}

say "Building with Clang and the address and undefined behaviour sanitizers"
configure_and_build build/sanitize -DLIGHTWELL_SANITIZE=ON
say "Running the tests under sanitizers"
# Embree's and draco's own allocations at exit are not ours to free.
ASAN_OPTIONS=detect_leaks=0 ctest --test-dir build/sanitize --output-on-failure --parallel 2 >&2

say "Fuzzing for $fuzz_seconds seconds"
configure_and_build build/fuzz -DLIGHTWELL_SANITIZE=ON -DLIGHTWELL_FUZZ=ON
targets=(build/fuzz/bin/*_fuzz)
for target in "${targets[@]}"; do
  name=$(basename "$target")
  corpus=build/fuzz/corpus/$name
  mkdir -p "$corpus"
  [ -d "fuzz/corpus/$name" ] && cp -n fuzz/corpus/"$name"/* "$corpus"
  "$target" -max_total_time=$((fuzz_seconds / ${#targets[@]})) -rss_limit_mb=2048 -timeout=20 -print_final_stats=0 \
    -verbosity=0 -artifact_prefix="build/fuzz/$name-" "$corpus" >&2
done

tests/shared_data.sh
