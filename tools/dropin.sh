#!/bin/bash
# dropin.sh FOLDER: the samplers as single files to paste into a renderer: C, GLSL, HLSL.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"

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

out=$1
make lobe_ggx "Smith-GGX reflection: caps, bounded caps, optimal caps" ggx_optimal ggx_bounded ggx_caps
make lobe_horizon "Smith-GGX reflection by horizon sampling: nothing rejected, shadowing followed" \
    ggx_horizon ggx_horizon_uniform
