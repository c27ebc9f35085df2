/* The resistance of a battery cell at 1 kHz, in firmware: v = v0 - r i, both followed by two parameters,
 * with r never told below a bound. Prints what a test compares with Python and what the program costs. */
#include "machine.h"
#include <forgetting.h>

#ifndef KIND
#define KIND fg_subspace_f32_2
#define N 2
#define FORGETTING_FACTOR 0.99609375
#endif
/* above what the cell has at the end, so that the bound holds it */
#ifndef LEAST_RESISTANCE
#define LEAST_RESISTANCE 0.078125f
#endif
#ifndef SAMPLES
#define SAMPLES 100000
#endif
/* 0 where it follows the data */
#ifndef INITIAL_COVARIANCE
#define INITIAL_COVARIANCE 100
#endif
/* bytes of an estimator, and of its saved state */
#ifndef ROOM
#define ROOM 512
#endif

extern const fg_kind KIND;

static _Alignas(8) unsigned char memory[ROOM];
static uint32_t state = 1, hash = 2166136261u;

/* Whole numbers of 256ths, which a float holds exactly: as the test makes them. */
static float next(void) {
    state = state * 1664525u + 1013904223u;
    return (float)(int32_t)((state >> 16) & 1023) / 256.0f - 2.0f;
}

/* The sample at k: a current and a voltage, and more currents where there are more parameters. */
static float sample(uint32_t k, float phi[N]) {
    float resistance = k < SAMPLES / 2 ? 0.05f : 0.075f, voltage = 3.75f;
    phi[0] = 1;
    for (int i = 1; i < N; ++i) phi[i] = -next();
    for (int i = 1; i < N; ++i) {
        float drop = resistance * phi[i];
        voltage = voltage + drop;
    }
    float noise = next() / 1024.0f;
    return voltage + noise;
}

/* FNV-1a over the bits of all estimates. */
static void add_to_hash(const float theta[N]) {
    for (int i = 0; i < N; ++i) {
        union {
            float number;
            uint32_t bits;
        } of = {theta[i]};
        for (int byte = 0; byte < 4; ++byte) hash = (hash ^ ((of.bits >> 8 * byte) & 255)) * 16777619u;
    }
}

int main(void) {
    fg_settings settings = {
        .parameters = N, .forgetting_factor = FORGETTING_FACTOR, .initial_covariance = INITIAL_COVARIANCE};
    fg_estimator *cell;
    float phi[N], theta[N];
    uint32_t most = 0, instructions = 0;
    if (fg_init(memory, sizeof memory, &KIND, &settings, &cell, NULL) != FG_OK) return 1;
    for (uint32_t k = 0; k < SAMPLES; ++k) {
        float voltage = sample(k, phi);
        if (k % 1000 == 999) paint_stack();
        uint32_t before = ticks();
        int32_t code = fg_update_f32(cell, phi, N, voltage, NULL);
        instructions += ticks_since(before);
        if (code != FG_OK) return 1;
        if (k % 1000 == 999 && painted_stack() > most) most = painted_stack();
        fg_theta_f32(cell, theta, N);
        add_to_hash(theta);
    }
#ifndef WITHOUT_SAVING
    static unsigned char bytes[ROOM];
    size_t length;
    if (fg_save(cell, bytes, sizeof bytes, &length) != FG_OK) return 1;
    print_bytes("state", bytes, (uint32_t)length);
    /* for whoever reads it; the estimator goes on unchanged */
    float lower[N], held[N];
    for (int i = 0; i < N; ++i) lower[i] = LEAST_RESISTANCE;
    if (fg_bounded_f32(cell, lower, NULL, N, held) != FG_OK) return 1;
    print_bytes("held", (const unsigned char *)held, sizeof held);
#endif
    print_number("hash", hash);
    print_number("microohms", (uint32_t)(1e6f * theta[1]));
    print_number("size", (uint32_t)fg_size(&KIND));
    print_number("stack", most);
    print_number("ticks", instructions);
    print_number("loop", ticks_of_loop());
    return 0;
}
