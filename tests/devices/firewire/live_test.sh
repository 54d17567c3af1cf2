#!/usr/bin/env bash
# The whole stack live: virtual FireWire bus -> driver -> perception -> mapper -> planner, five processes on UDP multicast,
# in a network of their own. FLOORNAV_LONG=1: an XB3 at 1280x960 and 7.5 Hz and a Bumblebee2 at 640x480 and 15 Hz, half a
# minute each, where the rates must hold; else the Bumblebee2 for some seconds on a machine that may be busy, where frames
# may be lost, if they are told, and the camera is unplugged half-way: the robot must stop.
#   live_test.sh BUILD
set -euo pipefail
build=$(cd "$1" && pwd)
root=$(cd "$(dirname "$0")/../../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

: >"$folder/robot.yaml"
cat >"$folder/live.sh" <<'LIVE'
set -eu
build=$1 folder=$2 root=$3
shift 3
cd "$folder"
for node in perception mapper planner; do
  "$build/bin/floornav-$node" --config robot.yaml 2>"$node.txt" &
done
code=0
"$build/bin/virtual-bumblebee" run --scene "$root/tools/simulator/scenes/furnished_room.yaml" "$@" --goal 5.4,0.1 -- \
  "$build/bin/floornav-bumblebee" --config robot.yaml || code=$?
kill -TERM $(jobs -p)
for job in $(jobs -p); do wait "$job" || { echo "a daemon ended badly"; code=1; }; done
[ "$code" -eq 0 ] || cat perception.txt mapper.txt planner.txt
exit "$code"
LIVE
live() { "$root/tools/private-network" bash "$folder/live.sh" "$build" "$folder" "$root" "$@"; }
if [ -n "${FLOORNAV_LONG:-}" ]; then
  live --camera xb3 --scene-seconds 6 --drive 30 --may-lose 3
  live --camera bb2 --scene-seconds 6 --drive 30 --may-lose 3
else
  live --camera bb2 --scene-seconds 1 --drive 5 --unplug-at 1.5 --may-lose 10000
fi
