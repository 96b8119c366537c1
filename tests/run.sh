#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test. The one command for tests on a fresh Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

bash samples/setup.sh build tests

cmake --preset release >/dev/null
cmake --build --preset release
ctest --preset release -j "$(nproc)"
