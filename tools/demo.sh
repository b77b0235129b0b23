#!/bin/bash
# demo.sh: what `make demo` shows: the gallery, the methods compared, and real files where there are any.
# Pictures go to build/demo.
set -eu

cd "$(dirname "$0")/.."
lobe=build/lobe
out=build/demo
scenes=../shared/scenes
methods="ndf ellipsoid caps bounded optimal horizon"
mkdir -p "$out"

picture() { # FILE, then the arguments of lobe render
    local file=$out/$1
    shift
    "$lobe" render "$@" -o "$file"
    echo "  $file"
}

# number NAME JSON: a number of a one-line JSON object.
number() {
    printf '%s\n' "$2" | sed -nE "s/.*\"$1\": ?([-+0-9.eE]+).*/\1/p"
}

compare_methods() {
    local size=160x90 spp=16 method line
    "$lobe" render gallery --size $size --spp 1024 --seed 1000 -o "$out/reference.pfm"
    echo
    echo "gallery, $size, $spp samples a pixel each, against 1024 samples:"
    printf '  %-10s %9s %16s %8s\n' method rejected "relative error" seconds
    for method in $methods; do
        line=$("$lobe" render gallery --size $size --spp $spp --method "$method" --json \
            --reference "$out/reference.pfm")
        awk -v m="$method" -v r="$(number rejected_share "$line")" -v e="$(number relmse "$line")" \
            -v s="$(number seconds "$line")" \
            'BEGIN { printf "  %-10s %8.1f%% %16.4f %8.2f\n", m, 100 * r, sqrt(e), s }'
    done
}

echo "Pictures:"
picture gallery.png gallery --size 960x540 --spp 64
if [ -d "$scenes" ]; then
    picture barrel.png "$scenes/models/barrel.glb" --env "$scenes/environments/venice.exr" \
        --size 640x480 --spp 32 --exposure 1
    picture bunny.png "$scenes/models/stanford-bunny.obj" --env "$scenes/environments/forest.exr" \
        --material 0.95,0.64,0.54,1,0.55 --size 640x480 --spp 32
fi
compare_methods
