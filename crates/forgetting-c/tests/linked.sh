#!/bin/sh
# A program that names one compact kind, or one bank, links no other size, no other rule and nothing that can panic.
set -eu
cat >"$WORK/one.c" <<'C'
#include <forgetting.h>

int main(void) {
    static _Alignas(16) unsigned char memory[4096];
    unsigned char bytes[4096];
    fg_settings settings = {.parameters = 4, .initial_covariance = 100};
    float phi[4] = {1, 2, 3, 4}, theta[4], p[16];
    fg_estimator *estimator;
    size_t length;
    float gamma = 2;
    if (fg_init(memory, sizeof memory, &KIND, &settings, &estimator, 0)) return 1;
    return fg_update_f32(estimator, phi, 4, 1, 0) || fg_update_after_f32(estimator, 2, phi, 4, 1, &gamma, 0) ||
           fg_bounded_f32(estimator, phi, 0, 4, theta) || (fg_set_theta_f32(estimator, theta, 4) && !BANK) || fg_theta_f32(estimator, theta, 4) ||
           fg_covariance_f32(estimator, p, 4) || fg_save(estimator, bytes, sizeof bytes, &length) ||
           fg_load(memory, sizeof memory, &KIND, bytes, length, &estimator, 0) || fg_reset(estimator);
}
C
for rule in none exponential subspace directional random_walk bank; do
    kind=fg_${rule}_f32_4
    bank=$([ $rule = bank ] && echo 1 || echo 0)
    $CC -std=c11 -DKIND="$kind" -DBANK="$bank" -I"$STAGE/include" -ffunction-sections "$WORK/one.c" -Wl,--gc-sections \
        "$STAGE/lib/libforgetting.a" -lm -o "$WORK/one"
    "$WORK/one"
    kinds=$(nm "$WORK/one" | grep -c ' [DdRr] fg_' || true)
    if [ "$kinds" != 1 ]; then
        echo "$kind: $kinds kinds are linked" >&2
        exit 1
    fi
    if nm -C "$WORK/one" | grep -E 'panick|panic_|rust_begin_unwind|core::fmt'; then
        echo "$kind: it can panic" >&2
        exit 1
    fi
    echo "$kind: $(size "$WORK/one" | awk 'NR == 2 {print $1}') bytes of code in the program, no panic"
done
