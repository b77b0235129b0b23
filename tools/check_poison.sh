#!/bin/bash
# check_poison.sh LIBLOBE.A: no object calls the mathematics of libm. Its results differ from version
# to version, and shaders do not have it.
set -eu

libm=$("${CC:-gcc}" -print-file-name=libm.so.6)
libm_names=$(nm -D --defined-only --format=posix "$libm" | awk '{ sub(/@.*/, "", $1); print $1 }')
called=$(nm -u --format=posix "$1" | awk 'NF > 1 { print $1 }')

found=$(comm -12 <(sort -u <<<"$libm_names") <(sort -u <<<"$called"))
if [ -n "$found" ]; then
    printf 'poison: calls %s of libm\n' $found
    exit 1
fi
echo "poison: $(wc -l <<<"$libm_names") names of libm, none called"
