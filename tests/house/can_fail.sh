#!/bin/bash
# can_fail.sh CHECK: tools/check_CHECK passes a small good tree and rejects broken ones.
set -eu

source "$(dirname "$0")/expect.sh"
tree=$scratch/a\ tree

# put FILE: standard input becomes a file of the tree.
put() {
    mkdir -p "$(dirname "$tree/$1")"
    cat >"$tree/$1"
}

# includes_reject TEXT FILE LINE: the check must reject the line in that file, which is restored.
includes_reject() {
    cp "$tree/$2" "$scratch/good"
    echo "$3" >>"$tree/$2"
    expect_fail "$1" "$tools/check_includes.py" "$tree"
    cp "$scratch/good" "$tree/$2"
}

includes() {
    expect_fail "0 files" "$tools/check_includes.py" "$tree"
    echo '#include <stdint.h>' | put include/lobe/a.h
    echo '#include <stdint.h>' | put kernel/bind/c.h
    echo 'K_FN real a(real x) { return x; }' | put kernel/a.h
    echo '#include "a.h"' | put kernel/b.h
    printf '%s\n' '#include <lobe/a.h>' '#include "bind/c.h"' '#include "../kernel/b.h"' | put lib/a.c
    echo '#include <lobe/a.h>' | put render/a.h
    printf '%s\n' '#include "lobe/a.h"' '#include <stdio.h>' | put app/a.c
    printf '%s\n' '#include "render/a.h"' '#include "kernel/b.h"' | put tests/a.c
    expect_pass "$tools/check_includes.py" "$tree"

    includes_reject "app/ may not include kernel/" app/a.c '#include "../kernel/b.h"'
    includes_reject "app/ may not include render/" app/a.c '#  include "render/a.h"'
    includes_reject "render/ may not include kernel/" render/a.h '#include "kernel/a.h"'
    includes_reject "lib/ may not include render/" lib/a.c '#include "../render/a.h"'
    includes_reject "lib/ may not include <math.h>" lib/a.c '#include <math.h>'
    includes_reject "kernel/ may not include include/" kernel/a.h '#include <lobe/a.h>'
    includes_reject "the binding does" kernel/a.h '#include <stdint.h>'
    includes_reject "include/ may not include kernel/" include/lobe/a.h '#include "../../kernel/a.h"'
    includes_reject "include/ may not include <stdio.h>" include/lobe/a.h '#include <stdio.h>'
    includes_reject "no such file" app/a.c '#include "absent.h"'
    expect_pass "$tools/check_includes.py" "$tree"
}

# words_reject CONTENT: a file with it must be found.
words_reject() {
    echo "$1" | put docs/b.md
    expect_fail "docs/b.md" "$tools/check_words.sh" "$tree"
    rm "$tree/docs/b.md"
}

words() {
    local word
    echo 'Great hacks, mktemp -d XXXXXXXX, and nothing to do.' | put docs/a.md
    expect_pass "$tools/check_words.sh" "$tree"
    for word in TO''DO FIX''ME XX''X HA''CK "is not imple""mented" "a place""holder" -march=na''tive; do
        words_reject "text with $word in it"
    done
    truncate -s 1500001 "$tree/docs/c.bin"
    expect_fail "docs/c.bin: larger" "$tools/check_words.sh" "$tree"
    rm "$tree/docs/c.bin"

    # In a repository: what git ignores is none of our business, what it does not is.
    git init -q "$tree"
    echo /build/ | put .gitignore
    echo "XX""X" | put build/a.c
    expect_pass "$tools/check_words.sh" "$tree"
    words_reject "XX""X"
}

format() {
    expect_fail "no files" "$tools/check_format.sh" "$scratch"
    printf 'int lobe_a(int b);\n\nint lobe_a(int b) {\n    return b;\n}\n' | put lib/a.c
    expect_pass "$tools/check_format.sh" "$tree"
    printf 'int lobe_a( int b );\n' | put lib/b.h
    expect_fail "lib/b.h:1" "$tools/check_format.sh" "$tree"
}

# headers_reject TEXT: standard input is a header that must be rejected, with this text.
headers_reject() {
    put include/lobe/b.h
    expect_fail "$1" "$tools/check_headers.sh" "$tree"
}

headers() {
    printf '#ifndef A\n#define A\nstruct lobe_a {\n    int b;\n};\n#endif\n' | put include/lobe/a.h
    expect_pass "$tools/check_headers.sh" "$tree"
    headers_reject "lobe/b.h: fails with: gcc -std=c99" <<<'uint32_t lobe_b(void);'
    headers_reject "lobe/b.h: fails with: clang -std=c17" <<<'struct lobe_b { int c; };'
    headers_reject "lobe/b.h: fails with: g++ -std=c++17" <<<'int lobe_b(int class);'
    headers_reject "lobe/b.h: fails with: clang -std=c99" <<<'_Static_assert(1, "C11");'
}

# shaders_reject TEXT: standard input is a kernel that must be rejected, with this text.
shaders_reject() {
    put kernel/b.h
    expect_fail "$1" "$tools/check_shaders.sh" "$tree"
}

shaders() {
    mkdir -p "$tree/kernel" "$tree/ssr/passes"
    cp -r "$tools/../kernel/bind" "$tree/kernel/bind"
    cp "$tools/../ssr/passes/bind_shader.h" "$tree/ssr/passes"
    expect_fail "0 compilations" "$tools/check_shaders.sh" "$tree"
    echo 'K_FN real twice(real x) { return R(2.0) * x; }' | put kernel/a.h
    expect_pass "$tools/check_shaders.sh" "$tree"
    shaders_reject "kernel/b.h: fails as glsl450.comp" <<<'K_FN real b(real *x) { return *x; }'
    # Accepted by one language, refused by another.
    shaders_reject "kernel/b.h: fails as essl310.comp" <<<'K_FN real b() { real x = 1; return x; }'
    shaders_reject "kernel/b.h: fails as kernel.hlsl" <<<'K_FN real b(real sample) { return dot(sample, line); }'
    shaders_reject "kernel/b.h: fails as kernel.hlsl" <<<'K_FN real b(real x) { return fract(x); }'
    shaders_reject "use k_and" <<<'K_FN bool b(bool x, bool y) { return x && y; }'
}

# library SOURCE: makes the archive and the shared library of one file.
library() {
    mkdir -p "$tree"
    echo "$1" >"$tree/a.c"
    gcc -O2 -fPIC -fno-math-errno -c "$tree/a.c" -o "$tree/a.o"
    rm -f "$tree/a.a"
    ar rcs "$tree/a.a" "$tree/a.o"
    gcc -shared "$tree/a.o" -o "$tree/a.so"
}

symbols() {
    local check=("$tools/check_symbols.sh" "$tree/a.a" "$tree/a.so")
    library '#include <string.h>
        static int a(const char *b, const char *c) { return strcmp(b, c); }
        int lobe_b(const char *b, const char *c) { return a(b, c); }'
    expect_pass "${check[@]}"
    library 'int lobe_b(void) { return 0; } int helper(void) { return 1; }'
    expect_fail "exported without lobe_: helper" "${check[@]}"
    library 'int lobe_b(void) { return 0; }
        __attribute__((visibility("hidden"))) int helper(void) { return 1; }'
    expect_fail "global without lobe_: helper" "${check[@]}"
    library 'int puts(const char *); int lobe_b(void) { return puts("b"); }'
    expect_fail "needed from outside: puts" "${check[@]}"
    library 'static int a; int *b(void); int *b(void) { return &a; }'
    expect_fail "0 exported" "${check[@]}"
}

poison() {
    local check=("$tools/check_poison.sh" "$tree/a.a")
    library 'float lobe_a(float x) { return __builtin_sqrtf(x); }'
    expect_pass "${check[@]}"
    library 'float sinf(float); float lobe_a(float x) { return sinf(x); }'
    expect_fail "calls sinf" "${check[@]}"
}

# loop NAME BODY: an archive with one loop of that name, among those of the batches.
loop() {
    mkdir -p "$tree"
    echo "float f(float); void $1(float *x, int n);
        void $1(float *x, int n) { for (int i = 0; i < n; ++i) x[i] = $2; }" \
        >"$tree/batch_sse41_f32.c"
    gcc -O3 -fno-math-errno -fno-trapping-math -c "$tree/batch_sse41_f32.c" \
        -o "$tree/batch_sse41_f32.c.o"
    rm -f "$tree/a.a"
    ar rcs "$tree/a.a" "$tree/batch_sse41_f32.c.o"
}

# pass BODY: an archive with a pass of lobe_ssr that is one loop of that body.
pass() {
    mkdir -p "$tree"
    echo "float f(float); void lobe_ssr_keep_z_sse41(float *x, int n);
        void lobe_ssr_keep_z_sse41(float *x, int n) { for (int i = 0; i < n; ++i) { float y; $1 } }" \
        >"$tree/accumulate.c"
    gcc -O3 -fno-math-errno -fno-trapping-math -c "$tree/accumulate.c" -o "$tree/accumulate.c.o"
    rm -f "$tree/a.a"
    ar rcs "$tree/a.a" "$tree/accumulate.c.o"
}

vectors() {
    local check=("$tools/check_vectors.sh" "$tree/a.a")
    [ "$(uname -m)" = x86_64 ] || return 0
    for name in a_sample_each a_normals_shared a_coated_rows; do
        loop "$name" '__builtin_sqrtf(x[i])'
        expect_pass "${check[@]}"
        loop "$name" 'x[i] > 0 ? x[i] + f(x[i]) : __builtin_sqrtf(x[i])'
        expect_fail "is scalar" "${check[@]}"
        expect_fail "calls a function" "${check[@]}"
    done
    library 'int lobe_a(void) { return 0; }'
    expect_fail "0 loops" "${check[@]}"
    pass 'y = x[i] * x[i] + x[i]; y = y * y - x[i]; y = y * x[i] + 1; x[i] = y * y;'
    expect_pass "${check[@]}"
    pass 'y = x[i] * x[i] + x[i]; y = y * y - x[i]; y = y * x[i] + 1; x[i] = f(y * y);'
    expect_fail "has a scalar loop" "${check[@]}"
}

"$1"
