#!/bin/bash
# check_vectors.sh LIBRARY.A...: every loop that has to be is made of vectors. Compilers give up silently.
# Of the batches (liblobe.a) and of shading (liblobe_render.a, every set) a loop must have packed square roots or divisions,
# or be the same code as another loop and jump there, and must call nothing. The passes of liblobe_ssr.a have several loops a function, between
# code that is scalar: each must have as much packed arithmetic as it has where all of them are vectors, and the step of
# the march, which is one loop, by itself. OBJDUMP: of another processor.
set -eu

"${OBJDUMP:-objdump}" -d --no-show-raw-insn "$@" | awk '
    BEGIN {
        # least of gcc 12 and clang 14 for every set
        least["trace"] = 275; least["reproject"] = 30; least["resolve"] = 380
        least["accumulate"] = 95; least["keep_z"] = 6; least["composite"] = 375
        step = 30
    }
    /file format/ {
        object = $1
        number++
        loops = object ~ /batch_(sse41|avx2|avx512|neon)_f(32|64)/
    }
    /^[0-9a-f]+ <.*>:/ {
        symbol = substr($2, 2, length($2) - 3)
        name = object " " number " " $2
        wanted = (loops && $2 ~ /_(sample|normals|eval)_(each|shared)>/) || $2 ~ /<(matte|.*_(metal|coated))_rows>/
        if (wanted) { seen[name] = 1; count++ }
        if (match(symbol, /^lobe_ssr_[a-z_]+_(sse41|avx2|avx512|neon)$/)) {
            pass = substr(symbol, 10)
            sub(/_[a-z0-9]+$/, "", pass)
            if (pass in least) { entry[number, pass] = symbol; count++ }
        }
    }
    wanted && /[ \t]v?(sqrt|div)p[sd][ \t]|fsqrt[ \t]+v|fdiv[ \t]+v/ { packed[name]++ }
    wanted && /[ \t]jmp? .*_((sample|normals|eval)_(each|shared)|(metal|coated)_rows)>$/ { packed[name]++ }
    wanted && /[ \t](call|bl)[ \t]/ { calls[name]++ }
    /[ \t]v?(add|sub|mul|div|sqrt|min|max|cmp[a-z]*)ps[ \t]/ ||
        /[ \t]f(add|sub|mul|div|sqrt|min|max|minnm|maxnm|cm[a-z]*)[ \t]+v/ {
        arithmetic[number, symbol]++
        # a loop that stands by itself
        if (symbol ~ /^(step_all|march_to)/) beside[number]++
    }
    /^[0-9a-f]+ <(step_all|march_to)[.>]/ { has_step[number] = 1 }
    END {
        for (name in seen) {
            if (!packed[name]) { print "vectors: " name " is scalar"; failed++ }
            if (calls[name]) { print "vectors: " name " calls a function"; failed++ }
        }
        for (key in entry) {
            split(key, part, SUBSEP)
            n = arithmetic[part[1], entry[key]]
            if (part[2] == "trace") n += beside[part[1]]
            if (n < least[part[2]]) {
                print "vectors: " entry[key] " has a scalar loop: " n + 0 " packed instructions of " least[part[2]]
                failed++
            }
            if (part[2] == "trace" && has_step[part[1]] && beside[part[1]] < step) {
                print "vectors: the march of " entry[key] " is scalar"
                failed++
            }
        }
        printf "vectors: %d loops, %d failed\n", count, failed
        exit !(count > 0 && failed == 0)
    }'
