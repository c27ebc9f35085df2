/* The resistance of a battery cell from its current and voltage: v = v0 - r i. The cell ages: r grows by
 * half, and the estimate follows. */
#include <forgetting.h>
#include <stdio.h>

static uint32_t state = 1;

/* A number in [-1, 1). */
static float noise(void) {
    state = state * 1664525u + 1013904223u;
    return (float)(state >> 8) / 8388608.0f - 1.0f;
}

int main(void) {
    static _Alignas(16) unsigned char memory[256];
    fg_settings settings = {
        .parameters = 2,
        .forgetting_factor = 0.995,
        .initial_covariance = 100,
        .initial_theta = (const double[]){3.6, 0},
    };
    fg_estimator *cell;
    fg_why why;
    if (fg_init(memory, sizeof memory, &fg_subspace_f32_2, &settings, &cell, &why) != FG_OK) {
        fprintf(stderr, "%s: %.*s\n", fg_strerror(why.code), (int)why.parameter.length, why.parameter.text);
        return 1;
    }
    for (int k = 0; k <= 4000; ++k) {
        float current = 2 + noise(), resistance = k < 2000 ? 0.05f : 0.075f;
        float voltage = 3.7f - resistance * current + 0.001f * noise();
        float phi[2] = {1, -current};
        int code = fg_update(cell, phi, 2, voltage, NULL);
        if (code != FG_OK) {
            fprintf(stderr, "%s\n", fg_strerror(code));
            return 1;
        }
        if (k % 1000 == 0) {
            float theta[2];
            fg_theta(cell, theta, 2);
            printf("after %4d samples: %.3f V, %.1f mOhm\n", k, theta[0], 1000 * theta[1]);
        }
    }
    return 0;
}
