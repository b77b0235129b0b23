#!/bin/bash
# test_bits.sh INPUTS SITE: the files that the page loads give the bits of the library, and the comparison
# sees a single changed number.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp "$2/kernel.js" "$scratch/kernel.mjs"
"$1" >"$scratch/inputs"
compare() {
    node "$here/bits.mjs" "$scratch/inputs" "$scratch/kernel.mjs" "$@"
}
compare "$2/lobe.wasm" "$2/lobe-simd.wasm"
for build in lobe lobe-simd; do
    if compare --spoil "$2/$build.wasm" >/dev/null; then
        echo "$build.wasm: a changed input was not seen"
        exit 1
    fi
done
