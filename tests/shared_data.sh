#!/usr/bin/env bash
# Takes every file of ../shared/data through the program. Rooms, scans, objects and what was reported, in a format that Lightwell reads,
# have to be read; other files may be refused in one line. What was read is baked, verified, checked by gltf-validator, streamed from the
# server and drawn. Broken files are refused in one line or read with a warning, in little time and memory. Prints a line a file.
# Without ../shared it says so and passes. Expects build/release and web/node_modules.
#   shared_data.sh [FOLDER...]   of ../shared/data; all by default
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1
data=../shared/data
program=$PWD/build/release/bin/lightwell
[ -d $data ] || { echo "left out: ../shared/data is not here"; exit 0; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
pack=$work/scene.lw.glb
bake_seconds=300              # the largest scan takes a twentieth of it on two free cores
step_seconds=60               # every other step
broken_kilobytes=$((4 << 20)) # of address space: a small scene with two threads takes a quarter of it
sky=(--environment "1,1,1")   # a bare scan has no lamp

taken=0
failures=0
progress='^[a-z ]*: [0-9.]* s$'
complain() { # WHAT [FILE...]: says it with the beginning of what was printed
  echo "FAILED   $1: $(cat "${@:2}" </dev/null 2>/dev/null | grep -v -e "$progress" -e '^$' | head -n 6 | cut -c1-200 | tr '\n' ' ')"
  failures=$((failures + 1))
}

# Runs a command with a limit of time; what it prints is in $work/out and $work/errors.
within() { # SECONDS COMMAND...
  timeout "$1" "${@:2}" >"$work/out" 2>"$work/errors"
}

# What was said besides warnings and the lines of progress.
reason() { grep -v -e '^lightwell: warning: ' -e "$progress" "$work/errors"; }
refused_in_one_line() { [ "$1" = 1 ] && [ "$(reason | wc -l)" = 1 ] && reason | grep -q '^lightwell: '; }

fetch_from_server() {
  local line server status
  exec {lines}< <(exec "$program" serve "$pack" --port 0 --json 2>"$work/server")
  server=$!
  read -r -t 10 -u "$lines" line
  within $step_seconds "$program" fetch "$(sed -E 's/.*"url":"([^"]*[^/"])\/?".*/\1/' <<<"$line")/packs/${pack##*/}" --quiet --json
  status=$?
  kill "$server"
  exec {lines}<&-
  return $status
}

# What happens to a pack after it was baked.
use_pack() { # FILE
  within $step_seconds "$program" verify "$pack" --quiet || { complain "verify $1" "$work/errors" "$work/out"; return; }
  within $step_seconds node tests/validate_pack.mjs "$pack" || { complain "gltf-validator $1" "$work/errors" "$work/out"; return; }
  fetch_from_server || { complain "fetch $1" "$work/errors" "$work/server"; return; }
  within $step_seconds "$program" render "$pack" --integrator ivg --size 64x48 --spp 4 "${sky[@]}" -o "$work/picture.png" --quiet &&
    [ -s "$work/picture.png" ] || { complain "render $1" "$work/errors"; return; }
  rm "$work/picture.png"
}

take() { # FILE MUST_READ
  local failures_before=$failures status figures
  rm -f "$pack"
  within $bake_seconds "$program" bake "$1" -o "$pack" "${sky[@]}" --photons 100k --grid 16 --quiet --json
  status=$?
  grep -q -e '--up z' "$work/out" && complain "$1 has its y axis up" "$work/out"
  if [ "$2" = no ] && refused_in_one_line $status; then
    echo "refused  $(reason | cut -c1-170)"
    return
  fi
  [ $status = 0 ] || { complain "bake $1 ended with $status" "$work/errors"; return; }
  figures=$(sed -E 's/.*"triangles":([0-9]+).*/\1 triangles/' "$work/out")
  use_pack "$1"
  [ $failures = $failures_before ] && echo "read     $1: $figures, $(stat -c %s "$pack") bytes"
}

# Of the broken files those that are only unusual.
is_sound() { case ${1##*/} in node-chain-20000-deep.glb | solid-but-binary.stl) true ;; *) false ;; esac; } # FILE

take_broken() { # FILE
  (ulimit -v $broken_kilobytes &&
    within $step_seconds "$program" bake "$1" -o "$pack" "${sky[@]}" --photons 1k --grid 2 --threads 2)
  local status=$? warning
  if [ $status = 0 ] && warning=$(grep -m1 '^lightwell: warning: ' "$work/errors"); then
    echo "read     $1: $(cut -c1-170 <<<"$warning")"
  elif [ $status = 0 ] && is_sound "$1"; then
    echo "read     $1: sound, only unusual"
  elif refused_in_one_line $status; then
    echo "refused  $(reason | cut -c1-170)"
  else
    complain "$1 ended with $status" "$work/errors"
  fi
}

is_readable_format() { case $1 in *.glb | *.gltf | *.obj | *.ply | *.obj.gz | *.ply.gz) true ;; *) false ;; esac; }

# The one of them that is no scene announces 300 million faces in a kilobyte.
reported() { # FILE
  case $1 in *33-draco-300M-faces.glb) take_broken "$1" ;; *) take "$1" yes ;; esac
}

folders=("$@")
[ $# -gt 0 ] || folders=(rooms scans objects reported gltf formats broken)
for folder in "${folders[@]}"; do
  while read -r file; do
    taken=$((taken + 1))
    case $folder in
      broken) take_broken "$file" ;;
      reported) reported "$file" ;;
      rooms | scans | objects) take "$file" "$(is_readable_format "$file" && echo yes || echo no)" ;;
      *) take "$file" no ;;
    esac
  done < <(find $data/"$folder" -type f ! -name '*.bin' ! -name '*.mtl' ! -name '*.png' ! -name '*.md' ! -name gltf-validator-errors.json | sort)
done
echo "$taken files, $failures failures"
[ $taken -gt 0 ] && [ $failures = 0 ]
