#!/usr/bin/env bash
# Takes every file of ../shared/data that the program can read through bake, verify, info and fetch, and every broken one through
# bake, which must refuse it in one line or read it with a warning. Prints a table. Without ../shared it says so and passes.
#   shared_data.sh [PHOTONS]
set -uo pipefail
cd "$(dirname "$0")/.."
photons=${1:-100k}
data=../shared/data
program=build/release/bin/lightwell
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
[ -d $data ] || { echo "left out: ../shared/data is not here"; exit 0; }

failures=0
complain() { echo "FAILED $*"; failures=$((failures + 1)); }

# A bare scan has no lamp: it gets a white sky.
take() { # FILE
  local file=$1 pack=$work/pack.glb
  timeout 300 "$program" bake "$file" -o "$pack" --photons "$photons" --grid 16 --environment 1,1,1 --quiet --json \
    >"$work/figures" 2>"$work/errors"
  local status=$?
  if [ $status = 1 ] && [ "$(wc -l <"$work/errors")" = 1 ]; then
    printf 'refused  %s\n' "$(cut -c1-150 "$work/errors")"
    return
  fi
  [ $status = 0 ] || { complain "bake $file: status $status: $(head -c 300 "$work/errors")"; return; }
  "$program" verify "$pack" --quiet >"$work/verify" 2>&1 || { complain "verify $file: $(head -c 300 "$work/verify")"; return; }
  "$program" fetch "$pack" --quiet --json >"$work/fetch" 2>&1 || { complain "fetch $file: $(head -c 300 "$work/fetch")"; return; }
  printf 'read     %s %s\n' "$file" "$(node -e '
    const f = JSON.parse(require("fs").readFileSync(process.argv[1]));
    console.log(`${f.triangles} triangles, ${f.pack_bytes} bytes, opening ${f.bytes.opening}, ${f.warnings.length} warnings`)' "$work/figures")"
  rm -f "$pack"
}

while read -r file; do
  take "$file"
done < <(find $data/rooms $data/scans $data/objects $data/gltf $data/formats -type f \
           \( -name '*.glb' -o -name '*.gltf' -o -name '*.obj' -o -name '*.ply' -o -name '*.gz' -o -name '*.stl' -o -name '*.drc' -o -name '*.json' \) | sort)

echo "broken:"
while read -r file; do
  timeout 60 bash -c "ulimit -v 8000000; exec $program bake '$file' -o '$work/pack.glb' --photons 1k --grid 2 --environment 1,1,1" \
    >/dev/null 2>"$work/errors"
  status=$?
  case $status in
    0) printf 'read     %s: %s\n' "$file" "$(grep -m1 warning "$work/errors" || echo 'no warning')" ;;
    1) grep -c '^lightwell: ' "$work/errors" >/dev/null && [ "$(grep -cv warning "$work/errors")" -ge 1 ] &&
         printf 'refused  %s\n' "$(grep -v warning "$work/errors" | tail -n 1 | cut -c1-170)" || complain "$file: no reason given" ;;
    *) complain "$file: status $status: $(tail -n 1 "$work/errors" | cut -c1-200)" ;;
  esac
  rm -f "$work/pack.glb"
done < <(find $data/broken -type f ! -name '*.bin' ! -name 'gltf-validator-errors.json' | sort)

[ $failures = 0 ] || { echo "$failures failures"; exit 1; }
