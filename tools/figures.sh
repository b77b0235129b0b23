#!/bin/bash
# figures.sh [OPTION...]: every figure of `lobe figure --list` into docs/figures, with the options given.
# Coordinates, not bits, are the same everywhere: fonts and cairo differ from system to system.
set -eu

cd "$(dirname "$0")/.."
mkdir -p docs/figures
build/lobe figure --list | while read -r name _; do
    echo "docs/figures/$name.svg"
    build/lobe figure "$name" -o "docs/figures/$name.svg" "$@"
done
