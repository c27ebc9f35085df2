#!/bin/sh
# Tests what is installed in $STAGE, as a program that uses it would: see the Makefile.
set -eu
cd "$(dirname "$0")/.."
work=$OUT/tests
mkdir -p "$work"
export ASAN_OPTIONS=detect_leaks=1
flags="-I$STAGE/include $WARN"
static="$STAGE/lib/libforgetting.a -lm"
shared="-L$STAGE/lib -lforgetting -Wl,-rpath,$STAGE/lib -lm"

have() { command -v "$1" >/dev/null 2>&1; }

echo "C and C++, AddressSanitizer and UBSan, static and shared library"
# shellcheck disable=SC2086
{
    $CC -std=c11 $flags $SANITIZE tests/test.c $static -o "$work/test_c_static"
    $CC -std=c11 $flags $SANITIZE tests/test.c $shared -o "$work/test_c"
    $CXX -std=c++17 $flags $SANITIZE tests/test.cpp $static -o "$work/test_cpp17"
    $CXX -std=c++20 $flags $SANITIZE tests/test.cpp $shared -o "$work/test_cpp20"
}
for test in test_c_static test_c test_cpp17 test_cpp20; do "$work/$test"; done

if have valgrind; then
    echo "the same program under valgrind, which sees the library's own accesses, too"
    # shellcheck disable=SC2086
    $CC -std=c11 $flags -g tests/test.c $static -o "$work/test_c_plain"
    valgrind --quiet --error-exitcode=1 --undef-value-errors=no --leak-check=full "$work/test_c_plain"
else
    echo "valgrind is not installed: the library's own accesses are not watched"
fi

echo "what a program links: sh tests/linked.sh"
STAGE=$STAGE WORK=$work CC=$CC sh tests/linked.sh

if have pkg-config; then
    echo "pkg-config, and the example"
    # shellcheck disable=SC2046
    PKG_CONFIG_PATH=$STAGE/lib/pkgconfig \
        sh -c "$CC -std=c11 examples/battery.c \$(pkg-config --cflags --libs forgetting) -o $work/battery"
    LD_LIBRARY_PATH=$STAGE/lib "$work/battery"
else
    echo "pkg-config is not installed: its file is not tested"
fi

if have cmake; then
    echo "CMake"
    rm -rf "$work/cmake"
    cmake -S tests/cmake -B "$work/cmake" -DCMAKE_PREFIX_PATH="$STAGE" >"$work/cmake.log"
    cmake --build "$work/cmake" >>"$work/cmake.log"
    "$work/cmake/shared" >/dev/null && "$work/cmake/static" | tail -1
else
    echo "CMake is not installed: its package is not tested"
fi

if "$PYTHON" -c 'import forgetting, pytest' 2>/dev/null; then
    echo "Python's bytes, both ways"
    PYTHONPATH=tests:${PYTHONPATH:-} FORGETTING_CPU=baseline \
        FORGETTING_LIBRARY=$STAGE/lib/libforgetting.so \
        "$PYTHON" -m pytest -q -p no:cacheprovider tests/test_python.py
else
    echo "Python has no forgetting: saved states are not compared with it"
fi
