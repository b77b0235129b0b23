#!/bin/bash
# test_page.sh SITE: the modules of the page that need no browser.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for module in dropin state; do
    cp "$1/$module.js" "$scratch/$module.mjs"
done
node "$here/state.mjs" "$scratch"
"$here/files.py" >"$scratch/files.json"
node "$here/code.mjs" "$scratch/files.json" "$1" "$scratch"
sed 's/int32_t/int64_t/' "$scratch/dropin.mjs" >"$scratch/x" && mv "$scratch/x" "$scratch/dropin.mjs"
if node "$here/code.mjs" "$scratch/files.json" "$1" "$scratch" >/dev/null; then
    echo "code: a changed word was not seen"
    exit 1
fi
