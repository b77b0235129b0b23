#!/bin/bash
# list_files.sh ROOT [PATHSPEC...]: the files of the tree, tracked or about to be, one a line.
# In an unpacked archive, where there is no git, everything outside build/.
set -eu

cd "$1"
shift
if [ -e .git ]; then
    # A tree may belong to somebody else than who checks it.
    git -c safe.directory='*' ls-files --cached --others --exclude-standard -- "$@" |
        while IFS= read -r file; do
            [ ! -f "$file" ] || printf '%s\n' "$file"
        done
else
    find . -type f -not -path './build/*' -printf '%P\n' | sort |
        while IFS= read -r file; do
            [ $# -gt 0 ] || printf '%s\n' "$file"
            for pattern in "$@"; do
                # shellcheck disable=SC2254  # a pattern is meant
                case $file in $pattern) printf '%s\n' "$file" && break ;; esac
            done
        done
fi
