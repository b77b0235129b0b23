#!/bin/bash
# test_neon.sh BITS [ROWS [SSR_BITS]]: the library for 64-bit Arm, run under qemu: scalar and NEON give the bits that this
# processor gives; and so for the passes of lobe ssr, whose loops are vectors. BITS and SSR_BITS are tests/lib/bits.c and
# tests/ssr/bits.c built for this processor.
set -eu

bits=$1
rows=${2:-2000}
ssr_bits=${3:-}
tree=$(cd "$(dirname "$0")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The flags of cmake/Compiler.cmake and lib/CMakeLists.txt.
compile="aarch64-linux-gnu-gcc -std=c17 -O2 -DNDEBUG -ffp-contract=off -fno-math-errno -fno-trapping-math -I$tree/include"
vectors="-O3 -fno-thread-jumps -fno-tree-pre -fno-unswitch-loops --param=sra-max-propagations=1000 -fschedule-insns -fsched-pressure"

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
[ -n "$ssr_bits" ] || exit 0

# What the passes need of ssr/: no scenes, files and OpenGL; the flags of ssr/CMakeLists.txt.
mkdir "$scratch/ssr"
compile="$compile -I$tree -D_POSIX_C_SOURCE=200809L -DLOBE_SSR_NEON -fopenmp"
for name in bands environment message noise pyramid ssr surface gl/absent; do
    echo "$compile -c $tree/ssr/$name.c -o $scratch/ssr/$(basename "$name").o"
done >"$scratch/jobs"
for set in scalar neon; do
    for name in accumulate composite reproject resolve trace; do
        echo "$compile $vectors -DLOBE_SSR_SET=$set -c $tree/ssr/$name.c -o $scratch/ssr/${set}_$name.o"
    done
done >>"$scratch/jobs"
echo "$compile -c $tree/tests/ssr/bits.c -o $scratch/ssr/bits.o" >>"$scratch/jobs"
xargs -P "$(nproc)" -I{} sh -c '{}' <"$scratch/jobs"
rm "$scratch/bits.o"
aarch64-linux-gnu-gcc -static -fopenmp -Wl,--no-warnings "$scratch"/*.o "$scratch"/ssr/*.o -lm -o "$scratch/ssr_bits"
OBJDUMP=aarch64-linux-gnu-objdump "$tree/tools/check_vectors.sh" "$scratch"/ssr/neon_*.o

qemu-aarch64 "$scratch/ssr_bits" >"$scratch/arm"
"$ssr_bits" >"$scratch/here"
diff "$scratch/here" "$scratch/arm"
echo "neon: $(wc -l <"$scratch/arm") ways through the passes have the same bits"
[ -s "$scratch/arm" ]
