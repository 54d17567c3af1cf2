# Sourced by quickstart and test: packages and build. Needs bash.

say() { printf '\033[1m==>\033[0m %s\n' "$*"; }
die() { printf '%s: %s\n' "${0##*/}" "$*" >&2; exit 1; }

# install_packages LIST...: installs what is missing of the lists, asking for root only if something is.
install_packages() {
  command -v apt-get >/dev/null || die "needs Debian 12's apt-get; on another system install what $* name by hand"
  local missing=() package
  for package in $(sed 's/#.*//' "$@"); do
    dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  say "installing ${#missing[@]} packages: ${missing[*]}"
  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || die "packages are missing and there is no sudo: as root, apt-get install ${missing[*]}"
    root=(sudo)
  fi
  "${root[@]}" apt-get -q update >/dev/null || die "apt-get update failed: is the network there?"
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}" \
    >"${TMPDIR:-/tmp}/floornav-apt.log" 2>&1 ||
    { tail -n 5 "${TMPDIR:-/tmp}/floornav-apt.log" >&2; die "apt-get install failed"; }
}

# build PRESET FOLDER [BUILD OPTION...] [-- CMAKE OPTION...]: configures where needed, and builds, several sources in
# one go (a full build in half of the time).
build() {
  local preset=$1 folder=$2 options=()
  shift 2
  while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1"); shift; done
  [ $# -eq 0 ] || shift
  local log
  log=$(mktemp)
  cmake --preset "$preset" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=6 "$@" >"$log" 2>&1 || { tail -n 20 "$log" >&2; rm -f "$log"; die "cmake failed"; }
  rm -f "$log"
  cmake --build "$folder" "${options[@]}"
}
