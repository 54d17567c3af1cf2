#!/usr/bin/env bash
# tools/spy comes up, finds every type, and shows every channel decoded; what it lacks it names in one line.
# usage: spy_test.sh BUILD_FOLDER NUMBER_OF_TYPES [SCREENSHOT.xwd]
set -euo pipefail
export FLOORNAV_BUILD=$1
types=$2
screenshot=${3:-}
spy=$(cd "$(dirname "$0")/../../.." && pwd)/tools/spy
folder=$(mktemp -d)
jobs_to_end=()
cleanup() {
  for job in "${jobs_to_end[@]}"; do kill "$job" 2>/dev/null || true; done
  wait
  rm -rf "$folder"
}
trap cleanup EXIT
fail() { echo "FAILED: $1"; cat "$folder"/*.out 2>/dev/null || true; exit 1; }

# within SECONDS WHAT COMMAND...: waits until the command succeeds.
within() {
  local deadline=$((SECONDS + $1)) what=$2
  shift 2
  until "$@" >/dev/null 2>&1; do
    [ $SECONDS -lt $deadline ] || fail "$what"
    sleep 0.2
  done
}

# expect_error TEXT COMMAND...: fails with one line that has the text.
expect_error() {
  local text=$1 said
  shift
  if said=$("$@" 2>&1); then fail "'$*' succeeded"; fi
  [ "$(wc -l <<<"$said")" -eq 1 ] && grep -qF -- "$text" <<<"$said" || fail "'$*' said: $said"
}

"$spy" --help | grep -q '^usage: tools/spy' || fail "no usage"
mkdir "$folder/bin"
for tool in bash dirname readlink; do ln -s "$(command -v $tool)" "$folder/bin"; done
expect_error "apt-get install default-jre" env PATH="$folder/bin" bash "$spy"
expect_error "floornav-types.jar: apt-get install default-jdk-headless" env FLOORNAV_BUILD="$folder" "$spy"
expect_error "DISPLAY is not set" env -u DISPLAY "$spy"
expect_error "--lcm-url needs a URL" "$spy" --lcm-url

Xvfb -displayfd 3 -screen 0 1500x1100x24 -nolisten tcp 3>"$folder/display" >"$folder/xvfb.out" 2>&1 &
jobs_to_end+=($!)
within 20 "Xvfb did not start" test -s "$folder/display"
export DISPLAY=:$(cat "$folder/display")

"$FLOORNAV_BUILD/bin/sample_publisher" "$LCM_DEFAULT_URL" 3000 >"$folder/publisher.out" 2>&1 &
jobs_to_end+=($!)
url=$LCM_DEFAULT_URL
env -u LCM_DEFAULT_URL "$spy" --lcm-url "$url" >"$folder/spy.out" 2>&1 &
spy_job=$!
jobs_to_end+=($spy_job)
within 60 "spy does not tell its types" grep -q "^Found $types LCM types" "$folder/spy.out"
within 60 "spy shows no window" xdotool search --onlyvisible --name '^LCM Spy$'

# Rows of 16 pixels under a heading, sorted by channel. A viewer opens only for a message that was decoded.
row=0
for channel in BUMBLEBEE_CLOUD GOAL GRID_MAP HEALTH KINECT_CLOUD LOCAL_TO_GLOBAL MAP_REQUEST PATH POSE SURFELS \
  TERRAIN_MAP; do
  shown() { xdotool search --onlyvisible --name "^$channel\$"; }
  open_viewer() {  # a click again while the viewer is on its way would fall on the viewer
    xdotool search --onlyvisible --name '^LCM Spy$' windowraise
    xdotool mousemove 60 $((27 + 16 * row)) click --repeat 2 --delay 60 1
    for _ in {1..40}; do shown && return; sleep 0.25; done
    return 1
  }
  within 60 "no viewer for $channel" open_viewer
  xdotool search --onlyvisible --name "^$channel\$" windowmove $((row % 3 * 500)) $((240 + row / 3 * 220))
  row=$((row + 1))
done
if [ -n "$screenshot" ]; then
  sleep 2
  xwd -root -silent -out "$screenshot"
fi
kill "$spy_job"
within 10 "spy does not end" bash -c "! kill -0 $spy_job"
echo "spy shows $row channels of $types types"
