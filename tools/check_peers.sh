#!/bin/bash
# check_peers.sh [OPTION...]: our pictures against Mitsuba's (bench/peers/check_peers.py), with the packages of
# bench/peers/requirements.txt, which are installed into build/peer-tools when they are not there yet.
set -eu

cd "$(dirname "$0")/.."
peers=bench/peers
packages=build/peer-tools
if ! cmp -s $peers/requirements.txt $packages/requirements.txt; then
    rm -rf $packages
    if ! "${PYTHON:-python3}" -m venv $packages ||
        ! $packages/bin/pip install -q --disable-pip-version-check -r $peers/requirements.txt; then
        echo "peers: the packages of $peers/requirements.txt cannot be installed from the Python package index;" \
            "connect this machine to it" >&2
        exit 1
    fi
    cp $peers/requirements.txt $packages/requirements.txt
fi
exec $packages/bin/python -B $peers/check_peers.py "$@"
