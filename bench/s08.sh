#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
#
# s08.sh [FOLDER]: the experiments of S08 (Web3D 2008, Figures 1 to 4, 6 and 7, and its test of quantisation) with the built-in
# box. Pictures go to FOLDER (build/s08) as PNG, and with ImageMagick as one JPEG a figure; figures are printed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

lightwell=build/release/bin/lightwell
out=${1:-build/s08}
mkdir -p "$out"

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }

bake() { # NODES: the box with so many nodes on the grid's longest axis, once
  [ -e "$out/box$1.lw.glb" ] || "$lightwell" bake box --grid "$1" --quiet -o "$out/box$1.lw.glb" >/dev/null
}

# NAME SCENE [options...]: every picture has the same size, samples and exposure.
picture() {
  local name=$1 scene=$2
  shift 2
  "$lightwell" render "$scene" --size 320x240 --spp 64 --exposure 0.5 --integrator ivg --quiet "$@" -o "$out/$name.png" >/dev/null
}

# FIGURE COLUMNS: its pictures side by side.
sheet() {
  command -v montage >/dev/null || return 0
  montage "$out/$1"?.png -tile "$2x" -geometry +2+2 -background white -quality 85 "$out/$1.jpg"
}

difference() { # METRIC NAME REFERENCE [options...]
  local metric=$1 name=$2 reference=$3
  shift 3
  printf '%-8s %s against %s: ' "$metric" "$name" "$reference"
  "$lightwell" diff "$out/$name.png" "$out/$reference.png" --metric "$metric" --json "$@"
}

bake 16
bake 32
small=$out/box16.lw.glb large=$out/box32.lw.glb

say "Figure 1: geometry and light refined independently (16 nodes)"
picture figure1a "$small" --level 0.002 --only direct
picture figure1b "$small" --level 0.002 --light-level 0.25
picture figure1c "$small" --level 0.02 --light-level 0.25
picture figure1d "$small"
sheet figure1 2

say "Figure 2: half of the nodes, indirect light: not filled, push-pull, push-pull with smoothing"
picture figure2a "$small" --only indirect --light-level 0.5 --fill none
picture figure2b "$small" --only indirect --light-level 0.5 --fill push-pull
picture figure2c "$small" --only indirect --light-level 0.5 --fill push-pull-smooth
picture figure2d "$small" --only indirect
sheet figure2 2
for name in figure2a figure2b figure2c; do difference deltae "$name" figure2d; done

say "Figure 3: all of the light, 0.2, 2, 20 and 100 % of the faces"
picture figure3a "$small" --level 0.002
picture figure3b "$small" --level 0.02
picture figure3c "$small" --level 0.2
picture figure3d "$small"
sheet figure3 2
for name in figure3a figure3b figure3c; do difference deltae "$name" figure3d; done

say "Figure 4: all of the geometry, 8 nodes of light, then 25, 75 and 100 %"
picture figure4a "$small" --only indirect --light-level 0
picture figure4b "$small" --only indirect --light-level 0.25
picture figure4c "$small" --only indirect --light-level 0.75
picture figure4d "$small" --only indirect
sheet figure4 2
for name in figure4a figure4b figure4c; do difference deltae "$name" figure4d; done
echo "Nodes and seconds, light first, at 10 Mbit/s and 50 ms:"
"$lightwell" fetch "$small" --strategy light --rate 10M --latency 50 --json |
  grep -o '"seconds":[0-9.]*,"bytes":[0-9]*,"faces":[0-9]*,"nodes":[0-9]*' | awk -F: '!seen[$5]++'

say "Figure 6: bytes of the light"
"$lightwell" info "$large" --json | grep -o '"nodes":\[[0-9,]*\]\|"bytes_per_node":[0-9.]*'

say "Figure 7: push-pull with and without smoothing (32 nodes, half of them)"
build/release/bin/light_bench --benchmark_filter='push_pull|decode' 2>/dev/null
picture figure7a "$large" --only indirect --light-level 0.5 --fill push-pull
picture figure7b "$large" --only indirect --light-level 0.5 --fill push-pull-smooth
picture figure7c "$large" --only indirect
sheet figure7 3
for name in figure7a figure7b; do difference deltae "$name" figure7c; done

say "Quantisation: light and geometry as they are streamed against floats (16 nodes)"
"$lightwell" render box --grid 16 --size 320x240 --spp 64 --exposure 0.5 --integrator ivg --quiet -o "$out/float.png" >/dev/null
for metric in lab deltae; do difference "$metric" figure1d float; done
