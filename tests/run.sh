#!/usr/bin/env bash
# Builds winnow's tests and examples and runs them:  tests/run.sh [preset]   (release, clang, asan)
# Installs what is missing first, where it may; says what to install where it may not.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
.ci/packages
echo "== configure ($preset)"
cmake --preset "$preset" >/dev/null
echo "== build"
cmake --build --preset "$preset"
echo "== test"
ctest --preset "$preset"
