#!/bin/bash
# test_wasm.sh BITS: the library as WebAssembly, run by Node: scalar and SIMD give the bits that this
# processor gives. BITS is tests/lib/bits.c built for this processor.
set -eu

bits=$1
rows=${2:-2000}
tree=$(cd "$(dirname "$0")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The flags of cmake/Compiler.cmake and lib/CMakeLists.txt; only what has to be fast is optimised, and only what
# the batches need is compiled.
compile="clang --target=wasm32-wasi -std=c17 -DNDEBUG -ffp-contract=off -fno-math-errno -fno-trapping-math -I$tree/include"

for name in lib/{batch_{simd128,scalar}_f{64,32},f64,f32,batch_f32,batch_f64,isa,methods,random} tests/lib/bits; do
    case $name in
    *_simd128_*) flags=-O2 ;;
    *) flags=-O1 ;;
    esac
    printf '%s\n' "$compile $flags -c $tree/$name.c -o $scratch/$(basename "$name").o"
done | xargs -P "$(nproc)" -I{} sh -c '{}'
clang --target=wasm32-wasi "$scratch"/*.o -lm -o "$scratch/bits.wasm"

cat >"$scratch/run.mjs" <<'EOF'
import { readFile } from "node:fs/promises";
import { WASI } from "node:wasi";

const wasi = new WASI({ version: "preview1", args: process.argv.slice(2), returnOnExit: true });
const module = await WebAssembly.compile(await readFile(process.argv[2]));
const imports = { wasi_snapshot_preview1: wasi.wasiImport };
process.exitCode = wasi.start(await WebAssembly.instantiate(module, imports));
EOF
# Node 18 asks for the first option; the second keeps it from warning of it.
node --experimental-wasi-unstable-preview1 --no-warnings "$scratch/run.mjs" "$scratch/bits.wasm" \
    "$rows" >"$scratch/wasm"
"$bits" "$rows" >"$scratch/here"
diff "$scratch/here" "$scratch/wasm"
echo "wasm: $(wc -l <"$scratch/wasm") batches of $rows rows have the same bits"
[ -s "$scratch/wasm" ]
