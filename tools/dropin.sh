#!/bin/bash
# dropin.sh FOLDER: the samplers as single files to paste into a renderer: C, GLSL, HLSL; and as shaders that
# run, GLSL 4.50 and SPIR-V for Vulkan 1.1: FOLDER/samplers and, the passes of `lobe ssr` in HLSL too, FOLDER/ssr.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
out=$1
mkdir -p "$out/samplers" "$out/ssr"

# make NAME TITLE KERNEL...
make() {
    local name=$1 title=$2 language
    shift 2
    for language in c glsl hlsl; do
        local file=$out/$name.${language/#c/h}
        "$here/dropin.py" "$language" "$@" --title "$title" >"$file.part"
        mv "$file.part" "$file"
        echo "$file"
    done
}

# pass NAME FILE... [--define WORD=TEXT...]: a shader, and NAME.hlsl
pass() {
    "$here/dropin.py" hlsl-pass "${@:2}" >"$out/$1.hlsl.part"
    mv "$out/$1.hlsl.part" "$out/$1.hlsl"
    echo "$out/$1.hlsl"
    shader "$@"
}

# shader NAME FILE... [--define WORD=TEXT...]: NAME.comp; NAME.spv where there is a compiler
shader() {
    local file=$out/$1
    shift
    "$here/dropin.py" pass "$@" >"$file.comp.part"
    mv "$file.comp.part" "$file.comp"
    echo "$file.comp"
    command -v glslangValidator >/dev/null || return 0
    glslangValidator --quiet --target-env vulkan1.1 -S comp -o "$file.spv.part" "$file.comp"
    mv "$file.spv.part" "$file.spv"
    echo "$file.spv"
}

# words PREFIX WORD... : --define options that name the functions of a kernel
words() {
    local kernel=$1 pair
    shift
    for pair in "$@"; do echo "--define=${pair%%=*}=${kernel}${pair#*=}"; done
}

make lobe_ggx "Smith-GGX reflection: caps, bounded caps, optimal caps" ggx_optimal ggx_bounded ggx_caps
make lobe_horizon "Smith-GGX reflection by horizon sampling: nothing rejected, shadowing followed" \
    ggx_horizon ggx_horizon_uniform

methods=$(sed -nE 's/^ *X\(GGX, SMITH, [A-Z_]+, (\w+)\).*/\1/p' "$here/../include/lobe/methods.h")
for kernel in $methods; do
    # shellcheck disable=SC2046  # one option a word
    shader "samplers/$kernel" kernel/bind/glsl.h "kernel/$kernel.h" ssr/shaders/sample.comp \
        $(words ggx SAMPLE_BASE=_base SAMPLE_BASE_OF=_base_of SAMPLE_PAIR_OF_WO=_pair_of_wo SAMPLE_EVAL=_eval) \
        $(words "$kernel" SAMPLE_STATE= SAMPLE_PREPARE=_prepare SAMPLE_DRAW=_draw SAMPLE_PDF=_pdf)
    # shellcheck disable=SC2046
    pass "ssr/trace_${kernel#ggx_}" ssr/shaders/common.glsl "kernel/$kernel.h" ssr/shaders/draw_lobe.glsl \
        ssr/shaders/trace.comp $(words "$kernel" SSR_STATE= SSR_PREPARE=_prepare SSR_SAMPLE=_draw)
done
pass ssr/trace_mirror ssr/shaders/draw_mirror.glsl ssr/shaders/trace.comp
for name in depth halve_depth halve_color reproject resolve accumulate keep_z composite; do
    pass "ssr/$name" "ssr/shaders/$name.comp"
done

# Without what reads and writes: everything that a port to other pictures calls.
"$here/dropin.py" hlsl-pass kernel/bind/hlsl.h ssr/passes/bind_shader.h ssr/passes/{accumulate,composite,pyramid,ray,resolve,trace}.h \
    >"$out/ssr/passes.hlsl.part"
mv "$out/ssr/passes.hlsl.part" "$out/ssr/passes.hlsl"
echo "$out/ssr/passes.hlsl"
