#!/usr/bin/env bash
# Installs the add-on into a Blender without settings, and uses it.   add_on.sh LIGHTWELL
set -euo pipefail
lightwell=$(realpath "$1")
here=$(dirname "$(realpath "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf '#!/bin/sh\nprintf "%%s\\n" "$1" >>"%s/opened"\n' "$folder" >"$folder/browser"
chmod +x "$folder/browser"
export BLENDER_USER_SCRIPTS=$folder/scripts BLENDER_USER_CONFIG=$folder/config BROWSER="$folder/browser %s"
mkdir -p "$BLENDER_USER_SCRIPTS/addons" "$BLENDER_USER_CONFIG"
blender -b --factory-startup --python-exit-code 1 --python "$here/add_on.py" -- \
  "$here/../../integrations/blender/lightwell.py" "$lightwell" "$folder" >"$folder/log" 2>&1 || true
grep -q '^The add-on works$' "$folder/log" || { cat "$folder/log" >&2; exit 1; }
