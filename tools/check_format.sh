#!/bin/bash
# check_format.sh [ROOT]: C and C++ files must look as clang-format would write them.
# To repair: tools/list_files.sh . '*.c' '*.h' '*.cpp' | xargs -d '\n' clang-format -i
set -eu

here=$(cd "$(dirname "$0")" && pwd)
root=${1:-$here/..}

mapfile -t files < <("$here/list_files.sh" "$root" '*.c' '*.h' '*.cpp')
if [ ${#files[@]} = 0 ]; then
    echo "format: no files in $root"
    exit 1
fi
cd "$root"
clang-format --style="file:$here/../.clang-format" --dry-run -Werror "${files[@]}"
echo "format: ${#files[@]} files"
