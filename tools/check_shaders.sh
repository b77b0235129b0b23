#!/bin/bash
# check_shaders.sh [ROOT]: every kernel file and every pass of ssr/passes, unedited, is GLSL 4.50, GLSL ES
# 3.10 and HLSL. Each is compiled to SPIR-V, and what comes out must satisfy spirv-val.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "${1:-$here/..}" && pwd)
kernel=$root/kernel
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

glsl() { # VERSION KERNEL-FILE
    cat <<END
#version $1
#extension GL_GOOGLE_include_directive : require
#include "bind/glsl.h"
#include "ssr/passes/bind_shader.h"
#include "$2"
layout(local_size_x = 1) in;
void main() {}
END
}

hlsl() { # KERNEL-FILE
    cat <<END
#include "bind/hlsl.h"
#include "ssr/passes/bind_shader.h"
#include "$1"
[numthreads(1, 1, 1)] void main() {}
END
}

# compile SOURCE [OPTION...]: 0 when it becomes valid SPIR-V. Nothing calls the functions of the
# kernel here: --keep-uncalled makes glslang generate their code all the same, and -Od keeps its
# optimiser, which runs on HLSL by default, from removing it again.
compile() {
    glslangValidator --quiet --target-env vulkan1.1 --keep-uncalled -Od -I"$kernel" -I"$root" -S comp \
        -e main "${@:2}" -o "$scratch/spirv" "$scratch/$1" &&
        spirv-val --target-env vulkan1.1 "$scratch/spirv"
}

shopt -s nullglob extglob
texts=("$kernel"/*.h "$root"/ssr/passes/!(bind_*).h)

# Both short-circuit: a branch, which no loop over rows can have.
if grep -nE '&&|\|\|' "${texts[@]}"; then
    echo "kernel: use k_and and k_or"
    exit 1
fi

count=0
failed=0
for file in "${texts[@]}"; do
    name=${file#"$root"/}
    glsl 450 "$name" >"$scratch/glsl450.comp"
    glsl "310 es" "$name" >"$scratch/essl310.comp"
    hlsl "$name" >"$scratch/kernel.hlsl"
    for source in "glsl450.comp" "essl310.comp" "kernel.hlsl -D"; do
        count=$((count + 1))
        # shellcheck disable=SC2086  # a source and its option
        if ! compile $source; then
            echo "$name: fails as ${source%% *}"
            failed=$((failed + 1))
        fi
    done
done
echo "shaders: $count compilations, $failed failed"
[ $failed = 0 ] && [ $count -gt 0 ]
