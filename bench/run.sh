#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
#
# run.sh [PART...]: prints the figures of docs/results again; each part shows its commands. What is missing on this machine
# (../shared with the models and the truth, nginx, the browser) is named and left out. `run.sh look SCENE...` looks at these scenes only.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

programs=build/release/bin
lightwell=$programs/lightwell
shared=../shared
out=build/bench
parts=(bake trace speed truth estimators peer real look leaks curve mesh light fetch server sizes frame growth direct rays sky)

show() { # Prints a command, then runs it.
  printf '\033[2m$ %s\033[0m\n' "$*" >&2
  "$@"
}

missing() { echo "left out: $* is missing"; }

pack() { # The real room where it is at hand, else the built-in one; its path is printed.
  local scene=box pack=$out/room.lw.glb
  [ -e "$shared/data/rooms/dragon-room.glb" ] && scene=$shared/data/rooms/dragon-room.glb
  [ -e "$pack" ] || show "$lightwell" bake "$scene" -o "$pack" --quiet --json >"$out/bake.json"
  echo "$pack"
}

bench_bake() {
  rm -f "$out/room.lw.glb"
  pack >/dev/null
  tr ',{' '\n' <"$out/bake.json" | grep -E 'triangles|nodes|photons|import|light"|geometry|write|peak_memory|pack_bytes|opening'
}

bench_trace() { show "$programs/trace_bench"; }

# A default bake with more options: processor seconds of all (Embree's tree, too, whose own part bake_bench --tree says), seconds of the light without Embree's tree, the stated error, memory.
speed_row() { # NAME SCENE [options]
  local name=$1 scene=$2 processor
  shift 2
  processor=$({ TIMEFORMAT=%U; time "$lightwell" bake "$scene" -o "$out/speed.lw.glb" --quiet --json "$@" >"$out/speed.json"; } 2>&1)
  python3 -c 'import json, sys
r = json.load(open(sys.argv[3]))
print("| %s | %s | %.1f | %.1f | %.0f |" % (sys.argv[1], sys.argv[2], r["seconds"]["light"], 100 * r["estimated_error"], r["peak_memory"] / 1e6))' "$name" "$processor" "$out/speed.json"
}

bench_speed() {
  local scene
  echo "| bake | processor, s | light, s | stated error, % | memory, MB |"
  echo "|---|---|---|---|---|"
  for scene in box-small "$shared"/truth/{a_cornell,b_tworooms,d_blob}.glb; do
    [[ $scene == box-small || -e $scene ]] || continue
    speed_row "$(basename "$scene"), --target-error 3" "$scene" --target-error 3
    speed_row "$(basename "$scene"), --preview" "$scene" --preview
    speed_row "$(basename "$scene")" "$scene"
  done
  for scene in "$shared"/data/rooms/{dragon-room,sponza}.glb; do
    [ -e "$scene" ] && speed_row "$(basename "$scene")" "$scene"
  done
  speed_row "box (1.1 M triangles)" box
  for threads in 1 2; do speed_row "box-small, --threads $threads" box-small --threads $threads; done
  for photons in 1M 64M; do speed_row "box-small, --method tracks --photons $photons" box-small --method tracks --photons $photons; done
  local rooms=() large=()
  for scene in "$shared"/truth/{a_cornell,b_tworooms,d_blob}.glb; do [ -e "$scene" ] && rooms+=("$scene"); done
  for scene in "$shared"/data/rooms/{dragon-room,sponza}.glb; do [ -e "$scene" ] && large+=("$scene"); done
  show "$programs/bake_bench" --tree box-small "${rooms[@]}" "${large[@]}" box
  [ ${#rooms[@]} = 0 ] || show "$programs/bake_bench" --nodes "${rooms[@]}"
}

# Fails beyond 3 % in root mean square, and beyond a bias of 0.5 % in free space or 1 % on surfaces.
bench_truth() {
  [ -d "$shared/truth" ] || { missing "$shared/truth"; return; }
  local scene points most_bias
  for scene in a_cornell b_tworooms c_furnace d_blob; do
    for points in free surf; do
      most_bias=1
      [ $points = free ] && most_bias=0.5
      show "$lightwell" probe "$shared/truth/$scene.glb" --points "$shared/truth/$scene.$points.indirect.csv" \
        --integrator ivg --quiet >"$out/$scene.$points.csv"
      printf '%s %s\n' "$scene" "$points"
      python3 "$shared/tools/compare_truth.py" "$shared/truth/$scene.$points.indirect.csv" "$out/$scene.$points.csv" --max-rms 3 --max-bias $most_bias |
        grep -E '^(rms|bias|p95)'
    done
  done
  # A pack's grid holds the sky's own light, too.
  local courtyard=tests/data/truth/e_courtyard
  show "$lightwell" bake "$courtyard.glb" -o "$out/courtyard.lw.glb" --quiet >/dev/null
  for points in free surf; do
    "$lightwell" probe "$out/courtyard.lw.glb" --points "$courtyard.$points.indirect_and_sky.csv" --integrator ivg --quiet >"$out/courtyard.csv"
    printf 'e_courtyard %s\n' "$points"
    python3 "$shared/tools/compare_truth.py" "$courtyard.$points.indirect_and_sky.csv" "$out/courtyard.csv" | grep -E '^(rms|bias|p95)'
  done
}

# Estimators in the truth's rooms: error against processor time.
bench_estimators() {
  [ -d "$shared/truth" ] || { missing "$shared/truth"; return; }
  show "$programs/bake_bench" "$shared/truth"
  show "$programs/bake_bench" --prefixes "$shared/truth"
}

# three.js's own baked light grid of 16 nodes an axis beside Lightwell's; 32 take an hour (node bench/peer_three.mjs SHARED 32).
bench_peer() {
  [ -d "$shared/truth" ] || { missing "$shared/truth"; return; }
  command -v chromium >/dev/null || { missing chromium; return; }
  show node bench/peer_three.mjs "$shared"
}

# A row of real scenes: a default bake against the path tracer at 300 points of the scene's own surfaces. The path tracer's noise, up to
# 1 % where the sky comes in by windows, is in it.
real_row() { # NAME SCENE [options of the environment]
  local name=$1 scene=$2
  shift 2
  mkdir -p "$out/real"
  python3 "$shared/tools/surface_rms.py" "$lightwell" "$scene" "$out/real" --points 300 --spp 16384 "$@" >"$out/real/row.json" 2>"$out/real/errors" ||
    { echo "| $name | failed: $(tail -1 "$out/real/errors") |"; return; }
  python3 -c 'import json, sys
r = json.load(open(sys.argv[2]))
print("| %s | %d | %.1f | %+.1f | %.1f | %.1f | %d | %d |" % (sys.argv[1], r["points"], r["rms"], r["bias"], r["p95"], r["estimated"], r["nodes"], r["light_bytes"]))' "$name" "$out/real/row.json"
}

# Real rooms, objects and scans: those without a lamp under a uniform sky, and under a picture of one.
bench_real() {
  [ -d "$shared/data" ] || { missing "$shared/data"; return; }
  local scene name sky
  echo "| scene | points | rms % | bias % | 95th percentile % | stated % | nodes | bytes of light |"
  echo "|---|---|---|---|---|---|---|---|"
  for scene in "$shared"/data/{rooms,objects,scans}/*.{glb,ply,obj,ply.gz,obj.gz}; do
    [ -e "$scene" ] || continue
    name=$(basename "$scene")
    if "$lightwell" bake "$scene" --grid 2 -o "$out/real.lw.glb" --quiet >/dev/null 2>&1; then
      real_row "$name" "$scene"
      continue
    fi
    real_row "$name, uniform sky" "$scene" --environment 1,1,1
    sky=$(find "$shared/data/hdr" -name '*.hdr' | sort | head -1)
    real_row "$name, $(basename "$sky")" "$scene" --environment "$sky"
  done
}

# What a user sees of real rooms, objects and scans, beside the path tracer: a table, and a sheet of pictures a scene in build/look.
bench_look() { # [SCENE...]: files, or names of files of ../shared/data; all of its rooms, objects and scans without
  [ -d "$shared/data" ] || { missing "$shared/data"; return; }
  command -v chromium >/dev/null || { missing chromium; return; }
  local name scene scenes=()
  [ $# -gt 0 ] || set -- "$shared"/data/{rooms,objects,scans}/*.{glb,ply,obj,stl,drc,ply.gz,obj.gz}
  for name in "$@"; do
    scene=$name
    [ -e "$scene" ] || scene=$(find "$shared/data" -name "$(basename "$name")")
    if [ -e "$scene" ]; then scenes+=("$scene"); else missing "$name"; fi
  done
  [ ${#scenes[@]} = 0 ] || show node bench/look.mjs build/look "${scenes[@]}"
}

# Rooms into which no light may come through a wall: a table, and the pictures of docs/results.
bench_leaks() {
  [ -d "$shared/data" ] || { missing "$shared/data"; return; }
  command -v chromium >/dev/null || { missing chromium; return; }
  show node bench/leaks.mjs "$out/leaks" docs/results/pictures "$shared/data/reported"
}

# Error against bytes: adaptive and regular grids, and what has come of a stream.
bench_curve() {
  [ -d "$shared/data" ] || { missing "$shared/data"; return; }
  mkdir -p "$out/curve"
  show python3 bench/error_curve.py "$lightwell" "$shared/data/rooms/sponza.glb" "$out/curve" --environment 1,1,1
  show python3 bench/error_curve.py "$lightwell" "$shared/data/rooms/living-room.glb" "$out/curve"
}

bench_mesh() { show "$programs/mesh_bench" --benchmark_filter=/1000; }

# Costs of the light grid; and in the truth's rooms bytes and errors of each record.
bench_light() {
  show "$programs/light_bench"
  [ -d "$shared/truth" ] || { missing "$shared/truth"; return; }
  show python3 bench/records.py "$lightwell" "$out" "$shared"/truth/{a_cornell,b_tworooms,d_blob}.glb
}

bench_fetch() {
  local pack
  pack=$(pack)
  show "$lightwell" fetch "$pack" --rate 10M --latency 50 --json |
    grep -o '^{"bytes":[0-9]*\|"requests":[0-9]*,"seconds":[0-9.]*\|"first_picture":{[^}]*}'
}

# What a processor second of `lightwell serve` and of nginx is worth in ranges of 64 KB: three rounds in turn, since the machine's
# state changes, and the ratio of the medians. nginx is set up as Debian's own nginx.conf has it.
bench_server() {
  local pack place round
  pack=$(realpath "$(pack)")
  place=$(realpath "$out")
  command -v nginx >/dev/null || { missing nginx; return; }
  cat >"$out/nginx.conf" <<TEXT
daemon off; worker_processes 1; pid $place/nginx.pid; error_log stderr crit;
events {}
http {
  access_log off; sendfile on; tcp_nopush on; keepalive_requests 1000000;
  server { listen 127.0.0.1:8098; root $(dirname "$pack"); }
}
TEXT
  "$lightwell" serve "$pack" --port 8097 --quiet >/dev/null &
  local ours=$!
  nginx -c "$place/nginx.conf" -p "$place" &
  local theirs=$!
  sleep 1
  rm -f "$out"/ranges.*
  for round in 1 2 3; do
    show python3 bench/ranges.py "lightwell serve" "http://127.0.0.1:8097/packs/room.lw.glb" $ours | tee -a "$out/ranges.ours"
    show python3 bench/ranges.py nginx "http://127.0.0.1:8098/room.lw.glb" $theirs | tee -a "$out/ranges.theirs"
  done
  kill $ours $theirs
  wait $ours $theirs 2>/dev/null || true
  awk -v ours="$(middle_rate "$out/ranges.ours")" -v theirs="$(middle_rate "$out/ranges.theirs")" \
    'BEGIN { printf "lightwell serve / nginx: %.2f (to be 0.9 or more)\n", ours / theirs; exit ours < 0.9 * theirs }'
}

middle_rate() { grep -o '[0-9]* ranges' "$1" | sort -n | sed -n '2s/ ranges//p'; } # FILE: the second of three

bench_sizes() { (cd web && show npm run --silent sizes); }

# The frame with the grid beside the one without, and the grid with bricks beside a regular one of the same scene.
bench_frame() {
  command -v chromium >/dev/null || { missing chromium; return; }
  show node bench/frame.mjs "$(pack)"
  [ -e "$out/regular.lw.glb" ] || show "$lightwell" bake box-small --grid 32 -o "$out/regular.lw.glb" --quiet
  show node bench/frame.mjs "$(built_in box-small)" "$out/regular.lw.glb"
  show node bench/first_picture.mjs "$(built_in box-small)" "$(pack)"
}

built_in() { # NAME: the path of a built-in scene's pack.
  [ -e "$out/$1.lw.glb" ] || show "$lightwell" bake "$1" -o "$out/$1.lw.glb" --quiet
  echo "$out/$1.lw.glb"
}

bench_growth() {
  command -v chromium >/dev/null || { missing chromium; return; }
  show node bench/growth.mjs "$(built_in box)"
}

bench_direct() {
  command -v chromium >/dev/null || { missing chromium; return; }
  show node bench/direct_light.mjs "$(built_in box-small)"
  show node bench/direct_orbit.mjs "$(built_in box-small)"
  show node bench/gloss_scene.mjs "$out/gloss.gltf"
  show "$lightwell" bake "$out/gloss.gltf" -o "$out/gloss.lw.glb" --photons 20000 --grid 4 --quiet
  show node bench/direct_light.mjs "$out/gloss.lw.glb" 1024
  show node bench/peer_shadows.mjs "$out/shadows.jpg"
  local scenes=(box-small two-rooms)
  [ -e "$shared/data/rooms/sponza.glb" ] && scenes+=("$shared/data/rooms/sponza.glb")
  show node bench/direct_cost.mjs "${scenes[@]}"
}

# Rays for shadows of one quality: by random points of a lamp, and in the page's order with the ratio.
bench_rays() { show "$programs/render_bench"; }

# What stands and what is scanned under a sky: by the grid alone, and with the sky as a lamp.
bench_sky() {
  command -v chromium >/dev/null || { missing chromium; return; }
  [ -d "$shared/data" ] || { missing "$shared/data"; return; }
  local name options
  while read -r name options; do
    # shellcheck disable=SC2086 # these are options
    show "$lightwell" bake "$shared/data/$name" --sky-apart always $options -o "$out/sky.lw.glb" --quiet >"$out/sky.txt" </dev/null
    show node bench/sky_lamp.mjs "$out/sky.lw.glb" </dev/null
  done <<SCENES
objects/chess-board.glb --environment 1,1,1
scans/lucy-100k.ply --up z --environment 1,1,1
scans/dragon-47k-big-endian-colours.ply --environment 1,1,1
objects/spot.obj --environment $shared/data/hdr/qwantani_afternoon_puresky_1k.hdr
rooms/sponza.glb --sky
rooms/garden-sun.glb --sky
SCENES
}

mkdir -p "$out"
if [ "${1:-}" = look ]; then
  bench_look "${@:2}"
  exit
fi
[ $# -gt 0 ] && parts=("$@")
for part in "${parts[@]}"; do
  printf '\n\033[1m%s\033[0m\n' "$part"
  "bench_$part"
done
