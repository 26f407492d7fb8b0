#!/usr/bin/env bash
# Makes the Debian package, unpacks it into an empty folder and uses what is in it: the program bakes a room and serves it with the
# page, man(1) reads the manual page without a complaint, bash completes. Expects build/release and web/dist.
set -euo pipefail
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'kill "${server:-}" 2>/dev/null || true; rm -rf "$work"' EXIT

complain() { echo "package: $*"; exit 1; }

(cd build/release && cpack --config CPackConfig.cmake -B "$work/package" >"$work/log" 2>&1) || { cat "$work/log"; exit 1; }
package=$(ls "$work"/package/*.deb)
dpkg -x "$package" "$work/root"
share=$work/root/usr/share
program=$work/root/usr/bin/lightwell
echo "${package##*/}: $(stat -c %s "$package") bytes, needs $(dpkg-deb -f "$package" Depends)"

for needed in libembree3 libdraco libmeshoptimizer libpng16 libjpeg libwebp libzstd libc6 libstdc++6; do
  dpkg-deb -f "$package" Depends | grep -q "$needed" || complain "it does not depend on $needed"
done
apt-get install --simulate "$package" >"$work/log" 2>&1 || complain "apt would not install it: $(tail -n 1 "$work/log")"
! grep -qF "$PWD" "$program" || complain "the program knows the folder it was built in"
[ "$("$program" --version)" = "$(dpkg-deb -f "$package" Version)" ] || complain "versions differ"

cd "$work" # nothing may be found by chance
"$program" bake "$OLDPWD/tests/data/truth/a_cornell.glb" -o room.lw.glb --grid 8 --quiet >/dev/null
"$program" serve room.lw.glb --port 0 >url &
server=$!
until [ -s url ]; do kill -0 $server; done
url=$(sed 's/.*"url":"\([^"]*\)".*/\1/' url)
"$program" fetch "${url}packs/room.lw.glb" --quiet >/dev/null
# All that the page asks for, as it was built.
for file in "$OLDPWD"/web/dist/{index.html,style.css,worker.js,lightwell.wasm,page*.js}; do
  python3 -c 'import sys, urllib.request as u; sys.stdout.buffer.write(u.urlopen(sys.argv[1]).read())' "$url${file##*/}" |
    cmp - "$file" || complain "the page lacks ${file##*/}"
done

[ -z "$(man --warnings -l "$share/man/man1/lightwell.1.gz" 2>&1 >/dev/null)" ] || complain "man has something against the manual page"
complete=$(bash -c 'source "$1"; COMP_WORDS=(lightwell serve --po) COMP_CWORD=2; _lightwell lightwell --po serve; echo "${COMPREPLY[@]}"' \
  bash "$share/bash-completion/completions/lightwell")
[ "$complete" = --port ] || complain "bash completes '$complete'"
echo "the program of the package bakes, serves the page and explains itself"
