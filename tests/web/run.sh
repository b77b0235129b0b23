#!/bin/bash
# run.sh SCRIPT [ARGUMENT...]: runs a script of this folder with the packages of requirements.txt, which are
# installed into LOBE_BUILD_DIR/web-tools when they are not there yet.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
tools=$LOBE_BUILD_DIR/web-tools
if ! cmp -s "$here/requirements.txt" "$tools/requirements.txt"; then
    rm -rf "$tools"
    if ! "${PYTHON:-python3}" -m venv "$tools" ||
        ! "$tools/bin/pip" install -q --disable-pip-version-check -r "$here/requirements.txt"; then
        echo "web: the packages of tests/web/requirements.txt cannot be installed from the Python package" \
            "index; connect this machine to it, or configure with -DLOBE_WEB_TESTS=OFF" >&2
        exit 1
    fi
    cp "$here/requirements.txt" "$tools/requirements.txt"
fi
exec "$tools/bin/python" -B "$here/$1" "${@:2}"
