#!/bin/bash
# test_setup.sh: tools/setup.sh asks the network only for what is missing, and only as root.
set -eu

source "$(dirname "$0")/expect.sh"

# stand_in NAME: a command that notes its call and goes on with standard input.
stand_in() {
    { printf '#!/bin/bash\necho "%s $*" >>"%s/calls"\n' "$1" "$scratch" && cat; } >"$scratch/bin/$1"
    chmod +x "$scratch/bin/$1"
}

# setup: run it with a fresh list of calls.
setup() {
    : >"$scratch/calls"
    PATH="$scratch/bin:$PATH" "$tools/setup.sh" check
}

# called TEXT: one of the calls was this.
called() {
    grep -qF -- "$1" "$scratch/calls" && return
    echo "must have called: $1"
    cat "$scratch/calls"
    exit 1
}

mkdir "$scratch/bin"
stand_in apt-get <<<''
stand_in id <<<'echo 0'
stand_in sudo <<<'exit 1'

# Everything there.
stand_in dpkg-query <<<'for name; do echo "installed $name"; done'
expect_pass setup
[ "$(grep -cv dpkg-query "$scratch/calls")" = 0 ]

# ninja-build gone, clang removed with its configuration left; we are root.
stand_in dpkg-query <<'END'
for name; do
    case $name in
    ninja-build) ;;
    clang) echo "config-files clang" ;;
    *) echo "installed $name" ;;
    esac
done
exit 1
END
expect_pass setup
called "apt-get -q -o DPkg::Lock::Timeout=300 update"
called "install -y --no-install-recommends clang ninja-build"

# The same for a user whose sudo asks for a password: one line to run, and no call of apt.
stand_in id <<<'echo 1000'
expect_fail "apt-get install --no-install-recommends clang ninja-build" setup
[ "$(grep -c apt-get "$scratch/calls")" = 0 ]

# And where sudo does not ask.
stand_in sudo <<<'[ "$1" != -n ] || shift; exec "$@"'
expect_pass setup
called "sudo -n env DEBIAN_FRONTEND=noninteractive apt-get"
called "apt-get -q -o DPkg::Lock::Timeout=300 install"
