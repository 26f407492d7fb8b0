#!/usr/bin/env bash
# A project outside of this one builds the README's example in each way that the README shows, from the README's own lines: as a
# folder, by FetchContent, by find_package and by pkg-config. Each program streams a pack.
#   outside.sh LIGHTWELL WHOLE_BUILD
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
program=$1
whole_build=$2
project=$whole_build/outside

# The n-th block of the README in a language.
shown() { # LANGUAGE N
  awk -v begin="^\`\`\`$1\$" -v wanted="$2" '/^```/ { inside = 0 } inside && count == wanted; $0 ~ begin { inside = 1; count++ }' \
    "$here/../../README.md" | grep . || { echo "README.md has no block $2 of $1" >&2; exit 1; }
}

rm -rf "$project"
mkdir -p "$project"
cd "$project"
ln -s "$here/../.." lightwell
cp "$here"/*.cpp .
# What the ways compile is the same, seen from folders of the same depth: the first one fills the compiler's cache for the others.
# Nothing is optimized, which takes the least time.
export CCACHE_BASEDIR=$project CCACHE_NOHASHDIR=1
export CMAKE_CXX_COMPILER_LAUNCHER=ccache CMAKE_GENERATOR=Ninja CMAKE_BUILD_TYPE=None
export PREFIX=$project/installed

# A client that looked for what only a baker needs would fail here.
without=()
for package in embree CLI11 GTest PNG JPEG ZLIB PkgConfig nlohmann_json draco meshoptimizer tinyobjloader tinyexr; do
  without+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done

run_quietly() { "$@" >log 2>&1 || { cat log; exit 1; }; }

build() { # NAME PROGRAM [CMake options...], from lines of CMake on stdin
  { printf 'cmake_minimum_required(VERSION 3.25)\nproject(outside LANGUAGES CXX)\nadd_executable(%s %s.cpp)\n' "$2" "$2"; cat; } >CMakeLists.txt
  run_quietly cmake -S . -B "$1" "${@:3}"
  run_quietly cmake --build "$1" --target "$2"
}

shown cmake 1 | build as_folder stream_a_pack "${without[@]}"
shown cmake 2 | build fetched stream_a_pack "${without[@]}"
run_quietly bash -euxc "$(shown sh 1)"
shown cmake 3 | build found stream_a_pack "${without[@]}" "-DCMAKE_PREFIX_PATH=$PREFIX"
PKG_CONFIG_PATH=$PREFIX/lib/pkgconfig run_quietly bash -euxc "$(shown sh 2)"
for example in as_folder/stream_a_pack fetched/stream_a_pack found/stream_a_pack stream_a_pack; do
  bash "$here/example.sh" "$program" "$project/$example"
done

# The whole build has the baker's rooms too.
run_quietly cmake --install "$whole_build" --prefix "$project/whole" --component development
shown cmake 4 | build baker light_of_a_pack "-DCMAKE_PREFIX_PATH=$project/whole"
"$program" bake furnace -o furnace.lw.glb --grid 4 --photons 10k --quiet >/dev/null
baker/light_of_a_pack furnace.lw.glb | grep -E '^[0-9.]+ [0-9.]+ [0-9.]+ W/m2$'
