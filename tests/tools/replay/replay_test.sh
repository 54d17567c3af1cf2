#!/usr/bin/env bash
# floornav-replay from outside: the same bytes every time and with any number of threads; wrong input is one line.
#   replay_test.sh BIN LOG
set -euo pipefail
bin=$1 log=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
fail() { echo "FAILED: $*"; failed=1; }

for run in "first 1" "again 1" "threads 2"; do
  set -- $run
  "$bin/floornav-replay" "$log" --out "$work/$1" --threads "$2" --goal 5.7,-0.6 2>/dev/null
  python3 - "$work/$1/summary.json" <<'PY'
import json, sys
summary = json.load(open(sys.argv[1]))
del summary["timing"]
json.dump(summary, open(sys.argv[1], "w"), sort_keys=True)
PY
done
for name in map.yaml map.pgm belief.tiff height.tiff map.png terrain.png path.csv surfels.csv summary.json result.lcm; do
  [ -s "$work/first/$name" ] || fail "$name is missing or empty"
done
diff -rq "$work/first" "$work/again" || fail "a second run gives other bytes"
diff -rq "$work/first" "$work/threads" || fail "two threads give other bytes"

# refused NAME ARGUMENT...: one line on stderr and an exit code.
refused() {
  local name=$1 code=0
  shift
  timeout 10 "$bin/floornav-replay" "$@" --out "$work/refused" >"$work/out" 2>"$work/err" || code=$?
  [ "$code" -ne 0 ] && [ "$code" -lt 124 ] || fail "$name: exit code $code"
  [ "$(wc -l <"$work/err")" -eq 1 ] || { fail "$name: not one line"; cat "$work/err"; }
  [ ! -e "$work/refused/map.pgm" ] || fail "$name: left a map"
}
head -c 100000 /dev/urandom >"$work/random.lcm"
: >"$work/empty.lcm"
echo "robot: {radius_cm: 45}" >"$work/unit.yaml"
echo "robot: {radius_m: -1}" >"$work/negative.yaml"
echo "robot: [" >"$work/broken.yaml"
refused "missing log" "$work/no.lcm"
refused "empty log" "$work/empty.lcm"
refused "random bytes" "$work/random.lcm"
refused "a folder" "$work"
refused "wrong unit" "$log" --config "$work/unit.yaml"
refused "impossible value" "$log" --config "$work/negative.yaml"
refused "broken YAML" "$log" --config "$work/broken.yaml"
refused "missing configuration" "$log" --config "$work/no.yaml"
refused "goal that is none" "$log" --goal here
maebot=${FLOORNAV_DATA:-}/maebot_log/convex.log
[ ! -e "$maebot" ] || refused "another stack's log" "$maebot"

# A log cut short is refused, and on request read as far as it goes.
head -c 400000 "$log" >"$work/cut.lcm"
refused "log cut short" "$work/cut.lcm"
"$bin/floornav-replay" "$work/cut.lcm" --salvage --out "$work/cut" 2>/dev/null || fail "--salvage reads nothing"
python3 -c 'import json, sys; sys.exit(json.load(open(sys.argv[1]))["log"]["damaged_bytes"] == 0)' \
  "$work/cut/summary.json" || fail "--salvage does not tell what was damaged"
exit $failed
