#!/bin/bash
# check_vectors.sh LIBLOBE.A: every loop of the batches became vectors. Compilers give up silently: a
# loop of an instruction set must have packed square roots or divisions, or be the same code as another
# loop and jump there, and must call nothing.
set -eu

objdump -d --no-show-raw-insn "$1" | awk '
    /file format/ {
        object = $1
        loops = object ~ /batch_(sse41|avx2|avx512|neon)_f(32|64)/
    }
    /^[0-9a-f]+ <.*>:/ {
        name = object " " $2
        wanted = loops && $2 ~ /_(sample|normals|eval)_(each|shared)>/
        if (wanted) { seen[name] = 1; count++ }
    }
    wanted && /[ \t]v?(sqrt|div)p[sd][ \t]|fsqrt[ \t]+v|fdiv[ \t]+v/ { packed[name]++ }
    wanted && /[ \t]jmp? .*_(sample|normals|eval)_(each|shared)>$/ { packed[name]++ }
    wanted && /[ \t](call|bl)[ \t]/ { calls[name]++ }
    END {
        for (name in seen) {
            if (!packed[name]) { print "vectors: " name " is scalar"; failed++ }
            if (calls[name]) { print "vectors: " name " calls a function"; failed++ }
        }
        printf "vectors: %d loops, %d failed\n", count, failed
        exit !(count > 0 && failed == 0)
    }'
