#!/bin/bash
# check.sh: every build, check and test; the last line is "N passed, N failed".
# A build counts as one, and so does every test of ctest.
set -u

cd "$(dirname "$0")/.."

passed=0
failed=0
jobs=$(nproc)

# build PRESET: configure and compile.
build() {
    echo "== build: $1"
    if cmake --preset "$1" --log-level=WARNING >/dev/null &&
        cmake --build --preset "$1" --parallel "$jobs"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        return 1
    fi
}

# tests PRESET [CTEST OPTION...]: run what is built. Counts what ctest says it ran.
tests() {
    local log=build/$1/check.log summary
    echo "== test: $*"
    ctest --preset "$1" --parallel "$jobs" "${@:2}" 2>&1 | tee "$log"
    summary=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+)$/\1 \2/p' \
        "$log")
    if [ -z "$summary" ]; then
        failed=$((failed + 1))
        return 1
    fi
    failed=$((failed + ${summary% *}))
    passed=$((passed + ${summary#* } - ${summary% *}))
}

# gcc runs everything; the checks of the tree itself need no second compiler.
build gcc && tests gcc
build clang && tests clang --label-exclude house
build asan && tests asan --label-exclude house

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
