#!/usr/bin/env bash
# Debian's lcm-logplayer plays a log to the three daemons, started apart, while lcm-logger records: the map that they
# end with has the same free and blocked vertices as floornav-replay's.
#   logplayer_test.sh BIN LOG
set -euo pipefail
bin=$1 log=$2
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$bin/floornav-perception" --print-config >"$work/robot.yaml"
"$bin/floornav-replay" "$log" --config "$work/robot.yaml" --out "$work/replay" 2>"$work/replay.err" || { cat "$work/replay.err"; exit 1; }
"$bin/final-map" "$work/replay/result.lcm" >"$work/replay.map"

cat >"$work/live.sh" <<'LIVE'
set -eu
bin=$1 log=$2 work=$3
for daemon in perception mapper planner; do
  "$bin/floornav-$daemon" --config "$work/robot.yaml" --replay >"$work/$daemon.out" 2>&1 &
done
lcm-logger --force "$work/live.lcm" >/dev/null 2>&1 &
logger=$!
sleep 2
lcm-logplayer --speed="${SPEED:-4}" "$log" >/dev/null 2>&1
sleep 2
kill -INT "$logger"
wait "$logger" || true
kill -TERM $(jobs -p) 2>/dev/null || true
failed=0
for job in $(jobs -p); do wait "$job" || failed=1; done
exit $failed
LIVE
"$root/tools/private-network" bash "$work/live.sh" "$bin" "$log" "$work" || { cat "$work"/*.out; echo "a daemon ended badly"; exit 1; }

"$bin/final-map" "$work/live.lcm" >"$work/live.map"
cells=$(wc -l <"$work/replay.map")
[ "$cells" -gt 5000 ] || { echo "only $cells vertices in replay's map"; exit 1; }
if ! diff -q "$work/replay.map" "$work/live.map" >/dev/null; then
  echo "the live map differs from replay's in $(diff "$work/replay.map" "$work/live.map" | grep -c '^[<>]') lines of $cells"
  cat "$work"/*.out
  exit 1
fi
echo "$cells vertices, the same live and in replay"
