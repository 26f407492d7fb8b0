#!/usr/bin/env bash
# What `./run test --all` adds: format and lint, every test under sanitizers (built by Clang) with ten times the seeds, ten
# minutes of fuzzing, and everything in ../shared/data baked, verified and streamed. Expects build/release.
#   all.sh [PART...]   one or several of: style sanitizers fuzz shared; all by default
set -euo pipefail
cd "$(dirname "$0")/.."
fuzz_seconds=${FUZZ_SECONDS:-600}

say() { printf '\033[1m%s\033[0m\n' "$*" >&2; }

style() {
  say "Checking the format"
  git ls-files '*.h' '*.cpp' | xargs clang-format-14 --dry-run -Werror
  say "Checking with clang-tidy"
  # The WebAssembly entry points are for another compiler.
  git ls-files 'lightwell/*.cpp' | grep -v '/client/wasm' | xargs -P 2 -n 4 clang-tidy-14 -p build/release --quiet >&2
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
  LIGHTWELL_TEST_SCALE=10 ctest --test-dir build/sanitize --output-on-failure --parallel 2 >&2
}

# What the fuzzer starts from: real files, and a client's script (fuzz/client_fuzz.cpp) that answers with a whole pack.
plant_seeds() {
  local seeds=build/fuzz/corpus pack=build/fuzz/corpus/pack_fuzz/sample
  mkdir -p $seeds/{pack,client,gltf}_fuzz
  build/sanitize/bin/sample_pack $pack 200
  python3 - $pack >$seeds/client_fuzz/sample <<'PYTHON'
import sys
pack = open(sys.argv[1], 'rb').read()[:65535]
respond, receive, wait = b'\0\0\0', b'\x08' + len(pack).to_bytes(2, 'little') + pack, b'\x07\0\0'
sys.stdout.buffer.write(respond + receive + 200 * wait)
PYTHON
  cp tests/data/truth/*.glb $seeds/gltf_fuzz
}

fuzz() {
  build_with_sanitizers
  plant_seeds
  say "Fuzzing for $fuzz_seconds seconds"
  local targets=(build/sanitize/bin/*_fuzz) target name corpus
  for target in "${targets[@]}"; do
    name=$(basename "$target")
    corpus=build/fuzz/corpus/$name
    mkdir -p "$corpus"
    "$target" -max_total_time=$((fuzz_seconds / ${#targets[@]})) -rss_limit_mb=2048 -timeout=20 -max_len=65536 -verbosity=0 \
      -artifact_prefix="build/fuzz/$name-" "$corpus" >&2
  done
}

shared() {
  say "Taking everything in ../shared/data through the program"
  tests/shared_data.sh
}

parts=("$@")
[ $# -gt 0 ] || parts=(style sanitizers fuzz shared)
for part in "${parts[@]}"; do
  case $part in
    style | sanitizers | fuzz | shared) "$part" ;;
    *) sed -n 2,4p "$0" >&2; exit 2 ;;
  esac
done
