#!/bin/bash
# check_words.sh [ROOT]: words that say "unfinished", files too large for a clone, flags that bind
# the build to one processor.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
root=${1:-$here/..}
max_bytes=1500000

# Written so that this file does not find itself.
words='\b(T[O]DO|F[I]XME|X[X]X|H[A]CK)\b|\b[Nn]ot imp[l]emented\b|\b[Pp]lace[h]older\b|-march=n[a]tive'

status=0
count=0
while IFS= read -r file; do
    count=$((count + 1))
    if LC_ALL=C.UTF-8 grep -nHIE "$words" "$root/$file"; then
        status=1
    fi
    if [ "$(stat -c %s "$root/$file")" -gt $max_bytes ]; then
        echo "$file: larger than $max_bytes bytes"
        status=1
    fi
done < <("$here/list_files.sh" "$root")

echo "words: $count files"
[ $status = 0 ] && [ $count -gt 0 ]
