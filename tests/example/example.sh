#!/usr/bin/env bash
# The README's C++ example is the program that was built, and it streams a pack from `lightwell serve` to its last triangle.
#   example.sh LIGHTWELL EXAMPLE
set -euo pipefail
cd "$(dirname "$0")"
program=$1
example=$2
work=$(mktemp -d)
trap 'kill "${server:-}" 2>/dev/null || true; rm -rf "$work"' EXIT

diff <(sed -n '/^```cpp$/,/^```$/p' ../../README.md | sed '1d;$d') stream_a_pack.cpp ||
  { echo "README.md does not show tests/example/stream_a_pack.cpp"; exit 1; }

"$program" bake box-small -o "$work/box.glb" --photons 10k --grid 4 --quiet >/dev/null
"$program" serve "$work/box.glb" --port 0 >"$work/url" &
server=$!
until [ -s "$work/url" ]; do kill -0 $server; done
url=$(sed 's/.*"url":"\([^"]*\)".*/\1/' "$work/url")
timeout 60 "$example" "${url}packs/box.glb" >"$work/output"
last=$(tail -n 1 "$work/output")
whole=$("$program" info "$work/box.glb" --json | grep -o '"faces":[0-9]*' | head -n 1 | cut -d: -f2)
[ "$last" = "$whole triangles" ] || { echo "it ended with '$last', not with $whole triangles"; exit 1; }
