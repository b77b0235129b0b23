#!/bin/bash
# test_dropin.sh: the single files compile by themselves, in every language, and draw what the library
# draws, bit for bit.
set -eu

tree=$(cd "$(dirname "$0")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$tree/tools/dropin.sh" "$scratch" >/dev/null

# shader LANGUAGE-OPTIONS FILE
shader() {
    local file=$1
    shift
    glslangValidator --quiet --target-env vulkan1.1 --keep-uncalled -Od -S comp -e main "$@" \
        -o "$scratch/spirv" "$file"
    spirv-val --target-env vulkan1.1 "$scratch/spirv"
}

count=0
for file in "$scratch"/*.h; do
    name=$(basename "$file" .h)
    for compiler in "gcc -std=c99 -xc" "clang -std=c17 -xc" "g++ -std=c++17 -xc++"; do
        # shellcheck disable=SC2086  # the words of $compiler
        echo "#include \"$name.h\"" | $compiler -Wall -Wextra -Werror -Wno-unused-function \
            -Wno-unused-parameter -I"$scratch" -fsyntax-only -
    done
    { echo '#version 450'; cat "$scratch/$name.glsl"; echo 'void main() {}'; } >"$scratch/a.comp"
    shader "$scratch/a.comp"
    { echo '#version 310 es'; printf 'precision highp float;\nprecision highp int;\n'
        cat "$scratch/$name.glsl"; echo 'void main() {}'; } >"$scratch/b.comp"
    shader "$scratch/b.comp"
    { cat "$scratch/$name.hlsl"; echo '[numthreads(1, 1, 1)] void main() {}'; } >"$scratch/c.hlsl"
    shader "$scratch/c.hlsl" -D
    count=$((count + 1))
done

# The lines of docs/shaders.md.
sed -n '/^```glsl/,/^```/p' "$tree/docs/shaders.md" | grep -v '^```' >"$scratch/lines.glsl"
grep -q lobe_ggx_bounded_draw "$scratch/lines.glsl"
{ printf '#version 450\n#extension GL_GOOGLE_include_directive : require\n'; cat "$scratch/lines.glsl"
    echo 'void main() {}'; } >"$scratch/e.comp"
shader "$scratch/e.comp" -I"$scratch"

# layout SPV: threads, and the number of each buffer that is used: a line each, sorted.
layout() {
    spirv-dis "$1" | sed -nE 's/.*(LocalSize .*)/\1/p; s/.* (Binding [0-9]+)/\1/p' | sort
}

# The passes in HLSL are whole shaders: valid, of the threads and the buffers of those in GLSL.
passes=0
for file in "$scratch"/ssr/*.hlsl; do
    name=${file%.hlsl}
    [ "$name" = "$scratch/ssr/passes" ] && continue
    glslangValidator --quiet --target-env vulkan1.1 -S comp -e main -D -o "$scratch/hlsl.spv" "$file"
    spirv-val --target-env vulkan1.1 "$scratch/hlsl.spv"
    comm -23 <(layout "$scratch/hlsl.spv") <(layout "$name.spv") | grep . && exit 1
    grep -q 'LocalSize 8 8 1' <(layout "$scratch/hlsl.spv")
    passes=$((passes + 1))
done

# What runs as it is: the compiler has made SPIR-V of all of it.
{ cat "$scratch/ssr/passes.hlsl"; echo '[numthreads(1, 1, 1)] void main() {}'; } >"$scratch/d.hlsl"
shader "$scratch/d.hlsl" -D
programs=0
for file in "$scratch"/{samplers,ssr}/*.comp; do
    spirv-val --target-env vulkan1.1 "${file%.comp}.spv"
    programs=$((programs + 1))
done

gcc -O2 -ffp-contract=off -I"$scratch" -I"$tree/include" "$tree/tests/house/dropin.c" \
    "$LOBE_BUILD_DIR/liblobe.a" -lm -o "$scratch/dropin"
"$scratch/dropin"
echo "dropin: $count kernels in three languages, $programs shaders, $passes passes in HLSL"
[ $count -gt 0 ] && [ $programs -gt 30 ] && [ $passes -gt 18 ]
