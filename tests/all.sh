#!/usr/bin/env bash
# What `./run test --all` adds: format and lint, every test under sanitizers (built by Clang) with ten times the seeds, ten
# minutes of fuzzing, ten of the server under faults, the formats of assimp, the npm package in slow toolchains, the add-on in
# Blender, the Debian package, and everything in ../shared/data baked, verified and streamed. Expects build/release.
# FUZZ_SECONDS and SOAK_SECONDS say how long.
#   all.sh [PART...]   one or several of: style sanitizers fuzz soak formats toolchains blender package shared; all by default
set -euo pipefail
cd "$(dirname "$0")/.."
fuzz_seconds=${FUZZ_SECONDS:-600}
soak_seconds=${SOAK_SECONDS:-600}

say() { printf '\033[1m%s\033[0m\n' "$*" >&2; }

# clang-tidy runs beside the compiler, which ccache spares the work: a file is looked at again when it or a header changes.
style() {
  say "Checking the format"
  git ls-files '*.h' '*.cpp' | xargs clang-format-14 --dry-run -Werror
  say "Checking with clang-tidy"
  mkdir -p build
  cmake -S . -B build/tidy -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DLIGHTWELL_WERROR=ON \
    "-DCMAKE_CXX_CLANG_TIDY=clang-tidy-14;--quiet" >build/tidy.log 2>&1 || { cat build/tidy.log >&2; exit 1; }
  ninja -C build/tidy --quiet -k 0 lightwell >&2
}

# One folder for tests and fuzz targets: the instrumentation for the fuzzer does nothing in a test.
build_with_sanitizers() {
  say "Building with Clang and the address and undefined behaviour sanitizers"
  mkdir -p build
  cmake -S . -B build/sanitize -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -gline-tables-only" \
    -DCMAKE_C_COMPILER=clang-19 -DCMAKE_CXX_COMPILER=clang++-19 -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DLIGHTWELL_WERROR=ON -DLIGHTWELL_SANITIZE=ON -DLIGHTWELL_FUZZ=ON >build/sanitize.log 2>&1 ||
    { cat build/sanitize.log >&2; exit 1; }
  ninja -C build/sanitize --quiet >&2
}

sanitizers() {
  build_with_sanitizers
  say "Running the tests under sanitizers"
  LIGHTWELL_TEST_SCALE=10 ctest --test-dir build/sanitize --output-on-failure --parallel 2 --timeout 7200 >&2
}

# A target's run ends at the first input that crashes it, leaks, takes 20 seconds or too much memory, and keeps that input. One
# piece of memory may be as large as the largest image that is read.
fuzz_target() { # NAME SECONDS
  local name=$1 log=build/fuzz/$1.log corpus=build/fuzz/corpus/$1 largest_piece=256
  case $name in gltf | import | texture) largest_piece=1100 ;; esac
  mkdir -p "$corpus"
  build/sanitize/bin/"${name}_fuzz" -max_total_time="$2" -timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=$largest_piece \
    -max_len=65536 -verbosity=0 -print_final_stats=1 -artifact_prefix="build/fuzz/$name-" "$corpus" build/fuzz/seeds/"$name" \
    >"$log" 2>&1 || { tail -n 50 "$log"; echo "$name: FAILED, the input is kept in build/fuzz"; return 1; }
  awk -v name="$name" '/^stat::/ { figure[$1] = $2 }
    END { printf "%-8s %9d executions, the slowest %d s, %d MB\n", name, figure["stat::number_of_executed_units:"],
          figure["stat::slowest_unit_time_sec:"], figure["stat::peak_rss_mb:"] }' "$log"
}

fuzz() {
  build_with_sanitizers
  build/sanitize/bin/fuzz_seeds build/fuzz/seeds
  local names
  mapfile -t names < <(cd build/sanitize/bin && ls -- *_fuzz | sed 's/_fuzz$//')
  say "Fuzzing for $fuzz_seconds seconds, two targets at a time"
  export -f fuzz_target
  printf '%s\n' "${names[@]}" |
    xargs -P 2 -I NAME bash -c "fuzz_target NAME $((2 * fuzz_seconds / ${#names[@]}))" >&2
}

soak() {
  say "Serving under faults for $soak_seconds seconds"
  mkdir -p build/soak
  # Some megabytes, more than the system keeps for a connection.
  build/release/bin/lightwell bake box --grid 4 --quiet -o build/soak/box.lw.glb >/dev/null
  tests/server_soak.py build/release/bin/lightwell build/soak/box.lw.glb --seconds "$soak_seconds" >&2
}

# What assimp reads needs a build that asks for it.
formats() {
  say "Building with assimp and reading its formats"
  cmake -S . -B build/assimp -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DLIGHTWELL_WERROR=ON \
    -DLIGHTWELL_ASSIMP=ON >build/assimp.log 2>&1 || { cat build/assimp.log >&2; exit 1; }
  ninja -C build/assimp --quiet scene_test >&2
  build/assimp/bin/scene_test --gtest_brief=1 --gtest_filter='*ImportAssimp*' >&2
}

toolchains() {
  say "Running the browser's slow tests"
  node --test --test-concurrency=1 tests/e2e/slow/*.test.mjs >&2
}

blender() {
  say "Using the add-on in Blender"
  tests/blender/add_on.sh build/release/bin/lightwell
}

package() {
  say "Making the Debian package and using what is in it"
  tests/package.sh >&2
}

shared() {
  say "Taking everything in ../shared/data through the program"
  tests/shared_data.sh
}

parts=("$@")
[ $# -gt 0 ] || parts=(style sanitizers fuzz soak formats toolchains blender package shared)
for part in "${parts[@]}"; do
  case $part in
    style | sanitizers | fuzz | soak | formats | toolchains | blender | package | shared) "$part" ;;
    *) sed -n 2,6p "$0" >&2; exit 2 ;;
  esac
done
