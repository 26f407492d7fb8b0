#!/usr/bin/env bash
# Fails when a file of a room includes a header of a room that the table of rooms gives it no arrow to.
#   arrows.sh ROOMS.txt SOURCE_FOLDER     (a line of ROOMS.txt: the room, then the rooms it may include)
set -euo pipefail
table=$1
source=$2
wrong=0
while read -r room allowed; do
  while IFS=: read -r file included; do
    case " $room $allowed " in
      *" $included "*) ;;
      *) echo "$file includes lightwell/$included/, but there is no arrow from $room to $included"; wrong=1 ;;
    esac
  done < <(grep -HoE '#include "lightwell/[a-z]+/' "$source/lightwell/$room"/*.{h,cpp} 2>/dev/null |
           sed -E 's/#include "lightwell\/([a-z]+)\//\1/' || true)
done < "$table"
# Only the one spelling is looked at above, so no other is allowed.
if grep -HnE '#include ("\.\.?/|<lightwell/)' -r "$source/lightwell" --include='*.h' --include='*.cpp'; then
  echo 'headers of rooms are included as "lightwell/ROOM/FILE"'
  wrong=1
fi
for folder in "$source"/lightwell/*/; do
  name=$(basename "$folder")
  grep -qE "^$name( |$)" "$table" || { echo "lightwell/$name is not in the table of rooms"; wrong=1; }
done
exit $wrong
