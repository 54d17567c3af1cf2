#!/usr/bin/env bash
# The whole stack live: virtual Kinect -> driver -> perception -> mapper -> planner, five processes on UDP multicast, in a
# network of their own. FLOORNAV_LONG=1: for a minute, and not one frame may be lost; else for nine seconds on a machine
# that may be busy, where a few may be, if they are told. The short form unplugs the camera half-way: the robot must stop.
# FLOORNAV_LOAD=1: beside as many processes that never rest as there are cores.
#   live_test.sh BUILD
set -euo pipefail
build=$(cd "$1" && pwd)
seconds=9 options="--may-lose 9 --unplug-at 4"
[ -z "${FLOORNAV_LONG:-}" ] || seconds=60 options="--may-lose 0"
root=$(cd "$(dirname "$0")/../../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$build/bin/floornav-simulate" drive --scene "$root/tools/simulator/scenes/furnished_room.yaml" \
  --seconds $((seconds < 10 ? 4 : 10)) -o "$folder/drive.lcm"
: >"$folder/robot.yaml"
cat >"$folder/live.sh" <<'LIVE'
set -eu
build=$1 folder=$2 seconds=$3 options=$4
cd "$folder"
for node in perception mapper planner; do
  "$build/bin/floornav-$node" --config robot.yaml 2>"$node.txt" &
done
load=
if [ -n "${FLOORNAV_LOAD:-}" ]; then
  for core in $(seq "$(nproc)"); do sh -c 'while :; do :; done' & load="$load $!"; done
fi
code=0
"$build/bin/virtual-kinect" run --log drive.lcm --drive "$seconds" $options --goal 5.4,0.1 -- \
  "$build/bin/floornav-kinect" --config robot.yaml || code=$?
for job in $load; do kill -KILL "$job"; wait "$job" 2>/dev/null || true; done
kill -TERM $(jobs -p)
for job in $(jobs -p); do wait "$job" || { echo "a daemon ended badly"; code=1; }; done
[ "$code" -eq 0 ] || cat perception.txt mapper.txt planner.txt
exit "$code"
LIVE
"$root/tools/private-network" bash "$folder/live.sh" "$build" "$folder" "$seconds" "$options"
