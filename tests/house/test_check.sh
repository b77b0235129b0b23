#!/bin/bash
# test_check.sh: tools/check.sh adds up what the builds and ctest say, and fails when one of them does.
set -eu

source "$(dirname "$0")/expect.sh"

# The script works on the tree that it lies in: a copy, with stand-ins for cmake and ctest.
mkdir -p "$scratch/bin" "$scratch/tree/tools" "$scratch/tree/build/"{gcc,clang,asan}
cp "$tools/check.sh" "$scratch/tree/tools"

stand_in() {
    { echo '#!/bin/bash' && cat; } >"$scratch/bin/$1"
    chmod +x "$scratch/bin/$1"
}

# closes_with LINE STATUS: the last line and the exit status of the check.
closes_with() {
    local status=0
    PATH="$scratch/bin:$PATH" "$scratch/tree/tools/check.sh" >"$scratch/.output" 2>&1 || status=$?
    [ "$(tail -n 1 "$scratch/.output")" = "$1" ] && [ $status = "$2" ] && return
    echo "must close with \"$1\" and status $2, not $status:"
    cat "$scratch/.output"
    exit 1
}

stand_in cmake <<<''
stand_in ctest <<<'echo "100% tests passed, 0 tests failed out of 5"'
closes_with "18 passed, 0 failed" 0

stand_in ctest <<<'echo "80% tests passed, 1 tests failed out of 5"; exit 8'
closes_with "15 passed, 3 failed" 1

# A ctest that dies without a summary.
stand_in ctest <<<'echo "No tests were found!!!"; exit 8'
closes_with "3 passed, 3 failed" 1

# A build that fails has no tests to run.
stand_in ctest <<<'echo "100% tests passed, 0 tests failed out of 5"'
stand_in cmake <<<'case "$*" in *"--build --preset clang"*) exit 1 ;; esac'
closes_with "12 passed, 1 failed" 1
