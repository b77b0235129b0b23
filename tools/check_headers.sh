#!/bin/bash
# check_headers.sh [ROOT]: every public header compiles alone, twice, as C99, C17 and C++17, by gcc
# and by clang.
set -u

root=${1:-$(dirname "$0")/..}
warnings=(-Wall -Wextra -Wpedantic -pedantic-errors -Werror)

count=0
failed=0
for header in "$root"/include/lobe/*.h; do
    name=lobe/$(basename "$header")
    for compiler in "gcc -std=c99 -xc" "gcc -std=c17 -xc" "g++ -std=c++17 -xc++" \
        "clang -std=c99 -xc" "clang -std=c17 -xc" "clang++ -std=c++17 -xc++"; do
        count=$((count + 1))
        # shellcheck disable=SC2086  # the words of $compiler
        # The declaration at the end: C forbids a file without any, as headers of macros alone are.
        if ! printf '#include <%s>\n#include <%s>\nextern int end;\n' "$name" "$name" |
            $compiler "${warnings[@]}" -I"$root/include" -fsyntax-only -; then
            echo "$name: fails with: $compiler"
            failed=$((failed + 1))
        fi
    done
done
echo "headers: $count compilations, $failed failed"
[ $failed = 0 ] && [ $count -gt 0 ]
