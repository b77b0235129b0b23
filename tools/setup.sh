#!/bin/bash
# setup.sh build|check|peers: install the Debian packages that building, checking, or comparing with Mitsuba, needs.
# When all are there it asks the network nothing.
set -eu

cd "$(dirname "$0")/.."

wanted() {
    # All else needs what building needs.
    case $1 in
    build) awk '$1 == "build" { print $2 }' tools/packages.txt ;;
    check | peers) awk -v class="$1" '$1 == "build" || $1 == class { print $2 }' tools/packages.txt ;;
    *) echo "usage: tools/setup.sh build|check|peers" >&2 && return 2 ;;
    esac
}

missing() {
    local installed
    installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null |
        awk '$1 == "installed" { print $2 }') || true
    comm -23 <(printf '%s\n' "$@" | sort -u) <(printf '%s\n' "$installed" | sort -u)
}

list=$(wanted "${1:-build}")
mapfile -t packages <<<"$list"

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "setup: not a Debian system; expecting the likes of: ${packages[*]}" >&2
    exit 0
fi

list=$(missing "${packages[@]}")
if [ -z "$list" ]; then
    exit 0
fi
mapfile -t absent <<<"$list"

if [ "$(id -u)" = 0 ]; then
    as_root=(env)
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    as_root=(sudo -n env)
else
    echo "setup: these packages are missing; run as root, then call make again:" >&2
    echo "apt-get update && apt-get install --no-install-recommends ${absent[*]}" >&2
    exit 1
fi

# Another apt may hold the lock (a machine that has just started): wait for it.
apt=("${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300)
echo "setup: installing ${absent[*]}"
# One dead third-party source makes update fail while Debian's own lists are fresh.
"${apt[@]}" update || echo "setup: apt-get update failed; trying with the lists at hand" >&2
"${apt[@]}" install -y --no-install-recommends "${absent[@]}"
