#!/bin/bash
# test_neon.sh BITS: the library for 64-bit Arm, run under qemu: scalar and NEON give the bits that this
# processor gives. BITS is tests/lib/bits.c built for this processor.
set -eu

bits=$1
rows=${2:-2000}
tree=$(cd "$(dirname "$0")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The flags of cmake/Compiler.cmake and lib/CMakeLists.txt.
compile="aarch64-linux-gnu-gcc -std=c17 -O2 -DNDEBUG -ffp-contract=off -fno-math-errno -fno-trapping-math -I$tree/include"
vectors="-O3 -fno-thread-jumps -fno-tree-pre -fno-unswitch-loops --param=sra-max-propagations=1000"

for source in "$tree"/lib/*.c "$tree/tests/lib/bits.c"; do
    case $source in
    *_sse41_* | *_avx* | *_simd128_*) continue ;;
    *_neon_*) flags=$vectors ;;
    *) flags= ;;
    esac
    printf '%s\n' "$compile $flags -c $source -o $scratch/$(basename "$source" .c).o"
done | xargs -P "$(nproc)" -I{} sh -c '{}'
aarch64-linux-gnu-gcc -static "$scratch"/*.o -lm -o "$scratch/bits"

qemu-aarch64 "$scratch/bits" "$rows" >"$scratch/arm"
"$bits" "$rows" >"$scratch/here"
diff "$scratch/here" "$scratch/arm"
echo "neon: $(wc -l <"$scratch/arm") batches of $rows rows have the same bits"
[ -s "$scratch/arm" ]
