/* The library through forgetting.h: estimates against the normal equations, and every malformed call. */
#include "check.h"
#include <forgetting.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 3, SAMPLES = 200 };

static uint32_t seed = 7;

static double uniform(void) {
    seed = seed * 1664525u + 1013904223u;
    return (seed >> 8) / 8388608.0 - 1;
}

static void sample(double phi[N], double *y) {
    static const double truth[N] = {1.5, -2, 0.25};
    *y = 0.01 * uniform();
    for (int i = 0; i < N; ++i) {
        phi[i] = uniform();
        *y += truth[i] * phi[i];
    }
}

/* theta of (R) theta = b, by elimination. */
static void solve(double r[N][N], double b[N], double theta[N]) {
    for (int i = 0; i < N; ++i) {
        for (int k = i + 1; k < N; ++k) {
            double factor = r[k][i] / r[i][i];
            for (int j = 0; j < N; ++j) r[k][j] -= factor * r[i][j];
            b[k] -= factor * b[i];
        }
    }
    for (int i = N - 1; i >= 0; --i) {
        theta[i] = b[i];
        for (int j = i + 1; j < N; ++j) theta[i] -= r[i][j] * theta[j];
        theta[i] /= r[i][i];
    }
}

static fg_settings usual(void) {
    fg_settings settings = {.parameters = N, .forgetting_factor = 0.97, .initial_covariance = 50};
    return settings;
}

static void *memory_for(const fg_kind *kind) {
    size_t alignment = fg_alignment(kind), size = fg_size(kind);
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

/* Exponential forgetting is weighted least squares, written down directly. */
static void estimates_are_those_of_the_normal_equations(const fg_kind *kind, fg_choice rule) {
    double r[N][N] = {{0}}, b[N] = {0}, expected[N], theta[N], phi[N], y;
    fg_settings settings = usual();
    settings.rule = rule;
    void *memory = memory_for(kind);
    fg_estimator *estimator;
    CHECK(fg_init(memory, fg_size(kind), kind, &settings, &estimator, NULL) == FG_OK);
    for (int i = 0; i < N; ++i) r[i][i] = 1 / settings.initial_covariance;
    for (int k = 0; k < SAMPLES; ++k) {
        fg_report_f64 report;
        double before;
        sample(phi, &y);
        CHECK(fg_predict_f64(estimator, phi, N, &before) == FG_OK);
        CHECK(fg_update_f64(estimator, phi, N, y, &report) == FG_OK);
        CHECK(report.used && !report.windup && report.forgetting_factor == 0.97 && report.weight == 1);
        CHECK(fabs(report.error - (y - before)) < 1e-12 && report.leverage > 0);
        for (int i = 0; i < N; ++i) {
            for (int j = 0; j < N; ++j) r[i][j] = 0.97 * r[i][j] + phi[i] * phi[j];
            b[i] = 0.97 * b[i] + phi[i] * y;
        }
    }
    double p[N * N], identity = 0;
    CHECK(fg_covariance_f64(estimator, p, N) == FG_OK);
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) {
            double sum = i == j ? -1 : 0;
            for (int k = 0; k < N; ++k) sum += p[i * N + k] * r[k][j];
            identity = fmax(identity, fabs(sum));
        }
    CHECK(identity < 1e-10);
    solve(r, b, expected);
    CHECK(fg_theta_f64(estimator, theta, N) == FG_OK);
    for (int i = 0; i < N; ++i) CHECK(fabs(theta[i] - expected[i]) < 1e-10);
    CHECK(fg_samples(estimator) == SAMPLES);
    CHECK(fg_reset(estimator) == FG_OK && fg_samples(estimator) == 0);
    CHECK(fg_theta_f64(estimator, theta, N) == FG_OK && theta[0] == 0 && theta[2] == 0);
    free(memory);
}

/* Forgetting by the clock and samples of their own variance, in the normal equations:
 * R <- lambda^dt R + phi phi'/gamma. */
static void time_and_variance_are_those_of_the_normal_equations(const fg_kind *kind, fg_choice rule) {
    double r[N][N] = {{0}}, b[N] = {0}, expected[N], theta[N], phi[N], y;
    fg_settings settings = usual();
    settings.rule = rule;
    void *memory = memory_for(kind);
    fg_estimator *estimator;
    CHECK(fg_init(memory, fg_size(kind), kind, &settings, &estimator, NULL) == FG_OK);
    for (int i = 0; i < N; ++i) r[i][i] = 1 / settings.initial_covariance;
    for (int k = 0; k < SAMPLES; ++k) {
        double elapsed = k % 5 * 0.75, gamma = exp(uniform()), lambda = pow(0.97, elapsed);
        fg_report_f64 report;
        sample(phi, &y);
        CHECK(fg_update_after_f64(estimator, elapsed, phi, N, y, &gamma, &report) == FG_OK);
        CHECK(report.used && fabs(report.forgetting_factor - lambda) < 1e-15);
        for (int i = 0; i < N; ++i) {
            for (int j = 0; j < N; ++j) r[i][j] = lambda * r[i][j] + phi[i] * phi[j] / gamma;
            b[i] = lambda * b[i] + phi[i] * y / gamma;
        }
    }
    solve(r, b, expected);
    CHECK(fg_theta_f64(estimator, theta, N) == FG_OK);
    for (int i = 0; i < N; ++i) CHECK(fabs(theta[i] - expected[i]) < 1e-10);
    free(memory);
}

/* (x - theta)' R (x - theta) */
static double distance(double r[N][N], const double x[N], const double theta[N]) {
    double sum = 0;
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) sum += (x[i] - theta[i]) * r[i][j] * (x[j] - theta[j]);
    return sum;
}

/* The estimate within bounds against a search: no point of the box is nearer in the metric of R, and what is
 * inside stays. */
static void bounds_are_held_in_the_metric_of_the_data(const fg_kind *kind, fg_choice rule) {
    double r[N][N] = {{0}}, theta[N], inside[N], phi[N], y;
    const double lower[N] = {-INFINITY, -1.5, 0.5}, upper[N] = {1.25, INFINITY, 0.75};
    fg_settings settings = usual();
    settings.rule = rule;
    void *memory = memory_for(kind);
    fg_estimator *estimator;
    CHECK(fg_init(memory, fg_size(kind), kind, &settings, &estimator, NULL) == FG_OK);
    for (int i = 0; i < N; ++i) r[i][i] = 1 / settings.initial_covariance;
    for (int k = 0; k < 40; ++k) {
        sample(phi, &y);
        phi[1] += 0.8 * phi[0];
        CHECK(fg_update_f64(estimator, phi, N, y, NULL) == FG_OK);
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j) r[i][j] = 0.97 * r[i][j] + phi[i] * phi[j];
        CHECK(fg_theta_f64(estimator, theta, N) == FG_OK);
        CHECK(fg_bounded_f64(estimator, lower, upper, N, inside) == FG_OK);
        double least = distance(r, inside, theta);
        for (int i = 0; i < N; ++i) CHECK(inside[i] >= lower[i] && inside[i] <= upper[i]);
        for (int trial = 0; trial < 200; ++trial) {
            double other[N], step = pow(10, -4 * fabs(uniform()));
            for (int i = 0; i < N; ++i) other[i] = fmin(fmax(inside[i] + step * uniform(), lower[i]), upper[i]);
            CHECK(distance(r, other, theta) >= least * (1 - 1e-9));
        }
    }
    CHECK(fg_bounded_f64(estimator, NULL, NULL, N, inside) == FG_OK && !memcmp(inside, theta, sizeof theta));
    CHECK(fg_set_theta_f64(estimator, phi, N) == FG_OK);
    CHECK(fg_theta_f64(estimator, theta, N) == FG_OK && !memcmp(phi, theta, sizeof theta));
    free(memory);
}

/* What is refused has changed nothing: all bytes of the memory are compared. */
static void refusals_change_nothing(const fg_kind *kind) {
    size_t size = fg_size(kind), length;
    unsigned char *memory = memory_for(kind), *copy = malloc(size);
    fg_settings settings = usual();
    fg_estimator *estimator;
    double phi[N], y, out[N * N];
    float single[N] = {1, 2, 3};
    memset(memory, 0, size);
    CHECK(fg_init(memory, size, kind, &settings, &estimator, NULL) == FG_OK);
    for (int k = 0; k < 20; ++k) {
        sample(phi, &y);
        CHECK(fg_update_f64(estimator, phi, N, y, NULL) == FG_OK);
    }
    CHECK(fg_save(estimator, NULL, 0, &length) == FG_OK);
    unsigned char *before = malloc(length), *after = malloc(length), *blob = malloc(length);
    CHECK(fg_save(estimator, before, length, &length) == FG_OK);
    memcpy(blob, before, length);
#define REFUSED(call, expected)                                                                  \
    do {                                                                                         \
        CHECK((call) == (expected));                                                             \
        CHECK(fg_save(estimator, after, length, &length) == FG_OK && !memcmp(before, after, length)); \
    } while (0)
    REFUSED(fg_update_f64(NULL, phi, N, y, NULL), FG_ERROR_NULL);
    REFUSED(fg_update_f64(estimator, NULL, N, y, NULL), FG_ERROR_NULL);
    REFUSED(fg_update_f64(estimator, phi, N - 1, y, NULL), FG_ERROR_LENGTH);
    REFUSED(fg_update_f64(estimator, phi, N + 1, y, NULL), FG_ERROR_LENGTH);
    REFUSED(fg_update_f32(estimator, single, N, 1, NULL), FG_ERROR_NUMBER_TYPE);
    REFUSED(fg_update_f64(estimator, phi, N, NAN, NULL), FG_ERROR_VALUE);
    REFUSED(fg_update_f64(estimator, phi, N, INFINITY, NULL), FG_ERROR_VALUE);
    REFUSED(fg_update_f64(estimator, phi, N, 1e300, NULL), FG_ERROR_RANGE);
    for (int i = 0; i < N; ++i) {
        double kept = phi[i];
        phi[i] = NAN;
        REFUSED(fg_update_f64(estimator, phi, N, y, NULL), FG_ERROR_VALUE);
        phi[i] = 1e200;
        REFUSED(fg_update_f64(estimator, phi, N, y, NULL), FG_ERROR_RANGE);
        phi[i] = kept;
    }
    double one = 1, wrong[] = {0, -1, NAN, INFINITY};
    REFUSED(fg_update_after_f64(NULL, 1, phi, N, y, NULL, NULL), FG_ERROR_NULL);
    REFUSED(fg_update_after_f64(estimator, 1, NULL, N, y, NULL, NULL), FG_ERROR_NULL);
    REFUSED(fg_update_after_f64(estimator, 1, phi, N + 1, y, &one, NULL), FG_ERROR_LENGTH);
    REFUSED(fg_update_after_f32(estimator, 1, single, N, 1, NULL, NULL), FG_ERROR_NUMBER_TYPE);
    REFUSED(fg_update_after_f64(estimator, 1, phi, N, NAN, &one, NULL), FG_ERROR_VALUE);
    REFUSED(fg_update_after_f64(estimator, 1, phi, N, 1e300, &one, NULL), FG_ERROR_RANGE);
    for (int i = 0; i < 4; ++i) {
        REFUSED(fg_update_after_f64(estimator, 1, phi, N, y, &wrong[i], NULL), FG_ERROR_VALUE);
        if (i > 0) REFUSED(fg_update_after_f64(estimator, wrong[i], phi, N, y, NULL, NULL), FG_ERROR_VALUE);
    }
    REFUSED(fg_set_theta_f64(estimator, NULL, N), FG_ERROR_NULL);
    REFUSED(fg_set_theta_f64(estimator, phi, N - 1), FG_ERROR_LENGTH);
    REFUSED(fg_set_theta_f32(estimator, single, N), FG_ERROR_NUMBER_TYPE);
    REFUSED(fg_set_theta_f64(estimator, (const double[]){1, NAN, 1}, N), FG_ERROR_VALUE);
    REFUSED(fg_set_theta_f64(estimator, (const double[]){1, 1, 1e200}, N), FG_ERROR_VALUE);
    out[0] = 42;
    REFUSED(fg_bounded_f64(estimator, NULL, NULL, N, NULL), FG_ERROR_NULL);
    REFUSED(fg_bounded_f64(estimator, NULL, NULL, 2, out), FG_ERROR_LENGTH);
    REFUSED(fg_bounded_f64(estimator, (const double[]){0, 0, NAN}, NULL, N, out), FG_ERROR_VALUE);
    REFUSED(fg_bounded_f64(estimator, (const double[]){0, 0, 2}, (const double[]){1, 1, 1}, N, out), FG_ERROR_VALUE);
    REFUSED(fg_bounded_f64(estimator, (const double[]){0, 0, INFINITY}, NULL, N, out), FG_ERROR_VALUE);
    REFUSED(fg_bounded_f32(estimator, NULL, NULL, N, single), FG_ERROR_NUMBER_TYPE);
    CHECK(out[0] == 42);
    REFUSED(fg_predict_f64(estimator, NULL, N, out), FG_ERROR_NULL);
    REFUSED(fg_predict_f64(estimator, phi, N, NULL), FG_ERROR_NULL);
    REFUSED(fg_theta_f64(estimator, NULL, N), FG_ERROR_NULL);
    REFUSED(fg_theta_f64(estimator, out, 1), FG_ERROR_LENGTH);
    REFUSED(fg_theta_f32(estimator, single, N), FG_ERROR_NUMBER_TYPE);
    REFUSED(fg_covariance_f64(estimator, NULL, N), FG_ERROR_NULL);
    REFUSED(fg_covariance_f64(estimator, out, 2), FG_ERROR_LENGTH);
    REFUSED(fg_health(estimator, NULL), FG_ERROR_NULL);
    fg_health_report health;
    REFUSED(fg_health(estimator, &health), FG_ERROR_UNSUPPORTED);
    REFUSED(fg_save(estimator, blob, length - 1, &length), FG_ERROR_MEMORY);
    REFUSED(fg_save(estimator, blob, length, NULL), FG_ERROR_NULL);
    REFUSED(fg_save(NULL, blob, length, &length), FG_ERROR_NULL);

    /* making and loading into the memory of an estimator, which stays as it is */
    fg_why why;
    memcpy(copy, memory, size);
    settings.forgetting_factor = 1.5;
    REFUSED(fg_init(memory, size, kind, &settings, NULL, &why), FG_ERROR_VALUE);
    CHECK(why.code == FG_ERROR_VALUE && why.value == 1.5 && why.index == -1);
    CHECK(why.parameter.length == 17 && !memcmp(why.parameter.text, "forgetting_factor", 17));
    CHECK(why.allowed.length == 6 && !memcmp(why.allowed.text, "(0, 1]", 6));
    settings = usual();
    settings.initial_covariance = -1;
    REFUSED(fg_init(memory, size, kind, &settings, NULL, &why), FG_ERROR_VALUE);
    settings = usual();
    settings.initial_theta = (const double[]){1, NAN, 1};
    REFUSED(fg_init(memory, size, kind, &settings, NULL, &why), FG_ERROR_VALUE);
    CHECK(why.index == 1);
    settings = usual();
    settings.parameters = 0;
    REFUSED(fg_init(memory, size, kind, &settings, NULL, NULL), FG_ERROR_VALUE);
    settings.parameters = 1000;
    REFUSED(fg_init(memory, size, kind, &settings, NULL, NULL), FG_ERROR_VALUE);
    settings = usual();
    settings.rule.name = "no such rule";
    REFUSED(fg_init(memory, size, kind, &settings, NULL, NULL), FG_ERROR_UNKNOWN);
    settings = usual();
    settings.rule = (fg_choice){"exponential", (const fg_parameter[]){{"nonsense", 1, NULL}}, 1};
    REFUSED(fg_init(memory, size, kind, &settings, NULL, NULL), FG_ERROR_UNKNOWN);
    settings = usual();
    REFUSED(fg_init(NULL, size, kind, &settings, NULL, NULL), FG_ERROR_NULL);
    REFUSED(fg_init(memory, size, NULL, &settings, NULL, NULL), FG_ERROR_NULL);
    REFUSED(fg_init(memory, size, kind, NULL, NULL, NULL), FG_ERROR_NULL);
    REFUSED(fg_init(memory, size - 1, kind, &settings, NULL, NULL), FG_ERROR_MEMORY);
    REFUSED(fg_init(memory + 1, size, kind, &settings, NULL, NULL), FG_ERROR_ALIGNMENT);
    REFUSED(fg_load(NULL, size, kind, before, length, NULL, NULL), FG_ERROR_NULL);
    REFUSED(fg_load(memory, size, kind, NULL, length, NULL, NULL), FG_ERROR_NULL);
    REFUSED(fg_load(memory, size - 1, kind, before, length, NULL, NULL), FG_ERROR_MEMORY);
    for (size_t i = 0; i < length; ++i) {
        memcpy(blob, before, length);
        blob[i] ^= 0x20;
        CHECK(fg_load(memory, size, kind, blob, length, NULL, &why) == FG_ERROR_STATE);
        CHECK(fg_load(memory, size, kind, before, i, NULL, NULL) == FG_ERROR_STATE);
    }
    CHECK(!memcmp(copy, memory, size));

    /* memory that holds no estimator */
    memset(copy, 0, size);
    CHECK(fg_update_f64((fg_estimator *)(void *)copy, phi, N, y, NULL) == FG_ERROR_NOT_AN_ESTIMATOR);
    CHECK(fg_samples((fg_estimator *)(void *)copy) == 0 && fg_samples(NULL) == 0);
    CHECK(fg_reset(NULL) == FG_ERROR_NULL);
    free(before), free(after), free(blob), free(copy), free(memory);
}

/* Saved in the middle, loaded elsewhere: bit for bit the same from then on. */
static void a_saved_estimator_goes_on(const fg_kind *kind) {
    unsigned char blobs[3][4096];
    size_t lengths[3];
    fg_settings settings = usual();
    if (kind == &fg_bank_f64_3) settings.forgetting_factor = 0;
    fg_estimator *first, *second;
    void *memory = memory_for(kind), *other = memory_for(kind);
    double phi[N], y;
    CHECK(fg_init(memory, fg_size(kind), kind, &settings, &first, NULL) == FG_OK);
    for (int k = 0; k < 50; ++k) {
        sample(phi, &y);
        CHECK(fg_update_f64(first, phi, N, y, NULL) == FG_OK);
    }
    CHECK(fg_save(first, blobs[0], sizeof blobs[0], &lengths[0]) == FG_OK);
    CHECK(fg_load(other, fg_size(kind), kind, blobs[0], lengths[0], &second, NULL) == FG_OK);
    for (int k = 0; k < 50; ++k) {
        sample(phi, &y);
        CHECK(fg_update_f64(first, phi, N, y, NULL) == FG_OK);
        CHECK(fg_update_f64(second, phi, N, y, NULL) == FG_OK);
    }
    CHECK(fg_save(first, blobs[1], sizeof blobs[1], &lengths[1]) == FG_OK);
    CHECK(fg_save(second, blobs[2], sizeof blobs[2], &lengths[2]) == FG_OK);
    CHECK(lengths[1] == lengths[2] && !memcmp(blobs[1], blobs[2], lengths[1]));
    free(memory), free(other);
}

static void kinds_are_found(void) {
    CHECK(fg_find("exponential", FG_F64, N) == &fg_exponential_f64_3);
    CHECK(fg_find("subspace", FG_F32, 8) == &fg_subspace_f32_8);
    CHECK(fg_find("bank", FG_F32, 4) == &fg_bank_f32_4 && !fg_find("bank", FG_F64, 9));
    CHECK(fg_find(NULL, FG_F64, 8) == &fg_general_f64_8 && fg_find(NULL, FG_F64, 9) == &fg_general_f64_32);
    CHECK(!fg_find("subspace", FG_F32, 9) && !fg_find("nothing", FG_F32, 2));
    CHECK(!fg_find(NULL, FG_F32, 9) && !fg_find(NULL, FG_F64, 33) && !fg_find(NULL, FG_F32, 0) && !fg_find(NULL, 5, 2));
    CHECK(fg_size(NULL) == 0 && fg_alignment(NULL) == 0);
    CHECK(fg_size(&fg_exponential_f32_4) <= 128);
}

static void every_code_has_words(void) {
    for (int code = FG_OK; code <= FG_ERROR_STATE; ++code) {
        CHECK(strlen(fg_strerror(code)) > 5 && strcmp(fg_strerror(code), fg_strerror(-1)));
    }
    CHECK(fg_abi_version() == FG_ABI_VERSION);
}

/* Of a general kind: a monitor, a rate, a gate, and exponential forgetting that winds up when the input
 * falls silent. */
static void choices_go_by_name(void) {
    const fg_kind *kind = &fg_general_f64_8;
    void *memory = memory_for(kind);
    fg_estimator *estimator;
    fg_settings settings = usual();
    fg_report_f64 report;
    fg_health_report health;
    double phi[N] = {1, 0, 0}, y;
    settings.rule.name = "exponential";
    settings.monitor = 1;
    CHECK(fg_init(memory, fg_size(kind), kind, &settings, &estimator, NULL) == FG_OK);
    for (int k = 0; k < 500; ++k) {
        if (k < 100) {
            sample(phi, &y);
        } else {
            phi[0] = 1, phi[1] = phi[2] = 0, y = 1;
        }
        CHECK(fg_update_f64(estimator, phi, N, y, &report) == FG_OK);
    }
    CHECK(report.windup && fg_health(estimator, &health) == FG_OK);
    CHECK(health.windup && !health.informed && health.samples == 500 && health.growth > 10);

    settings = usual();
    settings.rule.name = "subspace";
    settings.gate = (fg_choice){"dead_zone", (const fg_parameter[]){{"width", 0.5, NULL}, {"otherwise", 0, "freeze"}}, 2};
    settings.rate.name = "fortescue";
    settings.weighting.name = "huber";
    CHECK(fg_init(memory, fg_size(kind), kind, &settings, &estimator, NULL) == FG_OK);
    int frozen = 0;
    for (int k = 0; k < 200; ++k) {
        sample(phi, &y);
        CHECK(fg_update_f64(estimator, phi, N, y, &report) == FG_OK && report.used);
        frozen += report.gate == 1;
    }
    CHECK(frozen > 150 && frozen < 200);
    settings.gate = (fg_choice){"dead_zone", (const fg_parameter[]){{"otherwise", 0, "sleep"}}, 1};
    CHECK(fg_init(memory, fg_size(kind), kind, &settings, NULL, NULL) == FG_ERROR_VALUE);

    /* all defaults: units of the data */
    fg_settings plain = {.parameters = N};
    CHECK(fg_init(memory, fg_size(kind), kind, &plain, &estimator, NULL) == FG_OK);
    double theta[N];
    for (int k = 0; k < 200; ++k) {
        sample(phi, &y);
        for (int i = 0; i < N; ++i) phi[i] *= 1e6;
        CHECK(fg_update_f64(estimator, phi, N, y, NULL) == FG_OK);
    }
    CHECK(fg_theta_f64(estimator, theta, N) == FG_OK && fabs(theta[0] * 1e6 - 1.5) < 0.02);
    free(memory);
}

/* The functions without a number type in their names take that of the array. */
static void the_type_of_the_array_chooses(void) {
    unsigned char memory[2][256] __attribute__((aligned(16)));
    fg_settings settings = {.parameters = 2, .initial_covariance = 10};
    fg_estimator *single, *both;
    const float phi[] = {1, 2};
    const double wide[] = {1, 2};
    float theta[2], p[4], y;
    double theta_wide[2], p_wide[4], y_wide;
    CHECK(fg_init(memory[0], 256, &fg_random_walk_f32_2, &settings, &single, NULL) == FG_OK);
    CHECK(fg_init(memory[1], 256, &fg_random_walk_f64_2, &settings, &both, NULL) == FG_OK);
    CHECK(fg_update(single, phi, 2, 3, NULL) == FG_OK && fg_update(both, wide, 2, 3, NULL) == FG_OK);
    CHECK(fg_update_after(single, 2, phi, 2, 3, NULL, NULL) == FG_OK);
    CHECK(fg_update_after(both, 2, wide, 2, 3, NULL, NULL) == FG_OK);
    CHECK(fg_update(single, wide, 2, 3, NULL) == FG_ERROR_NUMBER_TYPE);
    CHECK(fg_theta(single, theta, 2) == FG_OK && fg_theta(both, theta_wide, 2) == FG_OK);
    CHECK(fg_covariance(single, p, 2) == FG_OK && fg_covariance(both, p_wide, 2) == FG_OK);
    CHECK(fg_predict(single, phi, 2, &y) == FG_OK && fg_predict(both, wide, 2, &y_wide) == FG_OK);
    CHECK(fabs(theta[0] - theta_wide[0]) < 1e-5 && fabs(p[1] - p_wide[1]) < 1e-5);
    CHECK(fabs(y - y_wide) < 1e-5 && fabs(y - 3) < 0.1);
    CHECK(fg_bounded(single, NULL, NULL, 2, theta) == FG_OK && fg_set_theta(single, theta, 2) == FG_OK);
    CHECK(fg_bounded(both, NULL, NULL, 2, theta_wide) == FG_OK && fg_set_theta(both, theta_wide, 2) == FG_OK);
    settings.forgetting_factor = 0.9;
    CHECK(fg_init(memory[0], 256, &fg_random_walk_f32_2, &settings, NULL, NULL) == FG_ERROR_UNSUPPORTED);
}

/* Nothing chosen: parameters that stand still for 500 samples, then jump. The bank predicts better than any
 * one of its walks could over both halves, whatever the units. */
static void a_bank_needs_no_settings(void) {
    const fg_kind *kind = &fg_bank_f64_3;
    static const double truth[2][N] = {{1.5, -2, 0.25}, {-1, 0.5, 2}};
    fg_settings settings = {.parameters = N};
    void *memory[2] = {memory_for(kind), memory_for(kind)};
    fg_estimator *bank[2];
    double before[FG_BANK_MEMBERS], weights[FG_BANK_MEMBERS], theta[2][N], p[N * N], y_of[2], squared = 0;
    fg_report_f64 report[2];
    for (int b = 0; b < 2; ++b)
        CHECK(fg_init(memory[b], fg_size(kind), kind, &settings, &bank[b], NULL) == FG_OK);
    /* each member is believed less beforehand than the slower one before it */
    for (int i = 0; i < FG_BANK_MEMBERS; ++i)
        before[i] = pow(0.93, i) * (1 - 0.93) / (1 - pow(0.93, FG_BANK_MEMBERS));
    for (int k = 0; k < 1000; ++k) {
        double phi[N], scaled[N], y = 0.1 * uniform();
        for (int i = 0; i < N; ++i) {
            phi[i] = uniform();
            scaled[i] = ldexp(phi[i], 20 * i - 20);
            y += truth[k / 500][i] * phi[i];
        }
        CHECK(fg_predict_f64(bank[0], phi, N, &y_of[0]) == FG_OK);
        CHECK(fg_update_f64(bank[0], phi, N, y, &report[0]) == FG_OK);
        CHECK(fg_update_f64(bank[1], scaled, N, y, &report[1]) == FG_OK);
        CHECK(fabs(report[0].error - (y - y_of[0])) < 1e-12 && report[0].leverage > 0 && report[0].weight == 1);
        CHECK(report[0].used && !report[0].windup && report[0].gate == 0 && report[0].forgetting_factor <= 1);
        CHECK(fabs(report[0].error - report[1].error) < 1e-9);
        if (k >= 50 && (k < 500 || k >= 530)) squared += report[0].error * report[0].error;
        CHECK(fg_weights_f64(bank[0], weights, FG_BANK_MEMBERS) == FG_OK);
        double sum = 0;
        for (int i = 0; i < FG_BANK_MEMBERS; ++i) {
            CHECK(weights[i] >= 0 && weights[i] <= 1);
            if (k < 3 * N) CHECK(fabs(weights[i] - before[i]) < 1e-15);
            sum += weights[i];
        }
        CHECK(fabs(sum - 1) < 1e-12);
    }
    /* the variance of the noise is 0.01/3 */
    CHECK(squared / 920 < 0.02);
    CHECK(fg_theta_f64(bank[0], theta[0], N) == FG_OK && fg_theta_f64(bank[1], theta[1], N) == FG_OK);
    for (int i = 0; i < N; ++i) {
        CHECK(fabs(theta[0][i] - truth[1][i]) < 0.1);
        CHECK(fabs(ldexp(theta[1][i], 20 * i - 20) - theta[0][i]) < 1e-9);
    }
    CHECK(fg_covariance_f64(bank[0], p, N) == FG_OK && p[0] > 0 && fabs(p[1] - p[N]) < 1e-12 * p[0]);
    CHECK(fg_samples(bank[0]) == 1000 && fg_reset(bank[0]) == FG_OK && fg_samples(bank[0]) == 0);
    CHECK(fg_weights(bank[0], weights, FG_BANK_MEMBERS) == FG_OK);
    CHECK(fabs(weights[0] - before[0]) < 1e-15 && fabs(weights[7] - before[7]) < 1e-15);
    free(memory[0]), free(memory[1]);
}

/* What a bank refuses has changed nothing. */
static void a_bank_refuses_what_it_has_not(void) {
    const fg_kind *kind = &fg_bank_f64_3;
    size_t size = fg_size(kind), length, other;
    unsigned char *memory = memory_for(kind), *copy = malloc(size), before[8192], after[8192];
    fg_settings settings = {.parameters = N, .initial_covariance = 10, .initial_theta = (const double[]){1, 2, 3}};
    fg_estimator *estimator, *rls;
    double phi[N], y, weights[FG_BANK_MEMBERS + 1], one[] = {1, 1, 1};
    float single[FG_BANK_MEMBERS];
    fg_health_report health;
    memset(memory, 0, size);
    CHECK(fg_init(memory, size, kind, &settings, &estimator, NULL) == FG_OK);
    CHECK(fg_theta_f64(estimator, phi, N) == FG_OK && fabs(phi[0] - 1) < 1e-15 && fabs(phi[2] - 3) < 1e-15);
    for (int k = 0; k < 40; ++k) {
        sample(phi, &y);
        CHECK(fg_update_f64(estimator, phi, N, y, NULL) == FG_OK);
    }
    CHECK(fg_save(estimator, before, sizeof before, &length) == FG_OK);
    REFUSED(fg_update_f64(estimator, phi, N - 1, y, NULL), FG_ERROR_LENGTH);
    REFUSED(fg_update_f64(estimator, NULL, N, y, NULL), FG_ERROR_NULL);
    REFUSED(fg_update_f64(estimator, phi, N, NAN, NULL), FG_ERROR_VALUE);
    REFUSED(fg_update_f64(estimator, phi, N, 1e300, NULL), FG_ERROR_RANGE);
    REFUSED(fg_update_f64(estimator, (const double[]){1, NAN, 1}, N, y, NULL), FG_ERROR_VALUE);
    REFUSED(fg_update_after_f64(estimator, -1, phi, N, y, NULL, NULL), FG_ERROR_VALUE);
    REFUSED(fg_update_after_f64(estimator, 1, phi, N, y, (const double[]){0}, NULL), FG_ERROR_VALUE);
    REFUSED(fg_update_f32(estimator, single, N, 1, NULL), FG_ERROR_NUMBER_TYPE);
    REFUSED(fg_set_theta_f64(estimator, one, N), FG_ERROR_UNSUPPORTED);
    REFUSED(fg_health(estimator, &health), FG_ERROR_UNSUPPORTED);
    REFUSED(fg_weights_f64(NULL, weights, FG_BANK_MEMBERS), FG_ERROR_NULL);
    REFUSED(fg_weights_f64(estimator, NULL, FG_BANK_MEMBERS), FG_ERROR_NULL);
    REFUSED(fg_weights_f64(estimator, weights, FG_BANK_MEMBERS - 1), FG_ERROR_LENGTH);
    REFUSED(fg_weights_f64(estimator, weights, FG_BANK_MEMBERS + 1), FG_ERROR_LENGTH);
    REFUSED(fg_weights_f32(estimator, single, FG_BANK_MEMBERS), FG_ERROR_NUMBER_TYPE);

    memcpy(copy, memory, size);
    fg_settings wrong = {.parameters = N, .initial_theta = one};
    CHECK(fg_init(memory, size, kind, &wrong, NULL, NULL) == FG_ERROR_UNSUPPORTED);
    wrong = (fg_settings){.parameters = N, .initial_covariance = -1};
    CHECK(fg_init(memory, size, kind, &wrong, NULL, NULL) == FG_ERROR_VALUE);
    wrong = (fg_settings){.parameters = N, .rule = {.name = "subspace"}};
    CHECK(fg_init(memory, size, kind, &wrong, NULL, NULL) == FG_ERROR_UNSUPPORTED);
    wrong = (fg_settings){.parameters = N, .gate = {.name = "dead_zone"}};
    CHECK(fg_init(memory, size, kind, &wrong, NULL, NULL) == FG_ERROR_UNSUPPORTED);
    wrong = (fg_settings){.parameters = N, .forgetting_factor = 0.9};
    CHECK(fg_init(memory, size, kind, &wrong, NULL, NULL) == FG_ERROR_UNSUPPORTED);
    wrong = (fg_settings){.parameters = N, .monitor = 1};
    CHECK(fg_init(memory, size, kind, &wrong, NULL, NULL) == FG_ERROR_UNSUPPORTED);
    wrong = (fg_settings){.parameters = N + 1};
    CHECK(fg_init(memory, size, kind, &wrong, NULL, NULL) == FG_ERROR_VALUE);
    for (size_t i = 0; i < length; ++i) {
        memcpy(after, before, length);
        after[i] ^= 0x20;
        CHECK(fg_load(memory, size, kind, after, length, NULL, NULL) == FG_ERROR_STATE);
        CHECK(fg_load(memory, size, kind, before, i, NULL, NULL) == FG_ERROR_STATE);
    }
    CHECK(!memcmp(copy, memory, size));

    /* a bank is no estimator of another kind, and none of these is a bank */
    void *place = memory_for(&fg_random_walk_f64_3);
    size_t room = fg_size(&fg_random_walk_f64_3);
    CHECK(fg_load(place, room, &fg_random_walk_f64_3, before, length, NULL, NULL) == FG_ERROR_STATE);
    settings.initial_theta = NULL;
    CHECK(fg_init(place, room, &fg_random_walk_f64_3, &settings, &rls, NULL) == FG_OK);
    CHECK(fg_weights_f64(rls, weights, FG_BANK_MEMBERS) == FG_ERROR_UNSUPPORTED);
    CHECK(fg_save(rls, after, sizeof after, &other) == FG_OK);
    CHECK(fg_load(memory, size, kind, after, other, NULL, NULL) == FG_ERROR_STATE);
    CHECK(!memcmp(copy, memory, size));
    free(place), free(copy), free(memory);
}

int main(void) {
    fg_choice none = {0}, exponential = {.name = "exponential"};
    estimates_are_those_of_the_normal_equations(&fg_exponential_f64_3, none);
    estimates_are_those_of_the_normal_equations(&fg_general_f64_8, exponential);
    estimates_are_those_of_the_normal_equations(&fg_general_f64_32, exponential);
    time_and_variance_are_those_of_the_normal_equations(&fg_exponential_f64_3, none);
    time_and_variance_are_those_of_the_normal_equations(&fg_general_f64_8, exponential);
    bounds_are_held_in_the_metric_of_the_data(&fg_exponential_f64_3, none);
    bounds_are_held_in_the_metric_of_the_data(&fg_general_f64_8, exponential);
    bounds_are_held_in_the_metric_of_the_data(&fg_general_f64_32, exponential);
    refusals_change_nothing(&fg_exponential_f64_3);
    refusals_change_nothing(&fg_general_f64_8);
    a_saved_estimator_goes_on(&fg_subspace_f64_3);
    a_saved_estimator_goes_on(&fg_general_f64_8);
    a_saved_estimator_goes_on(&fg_bank_f64_3);
    a_bank_needs_no_settings();
    a_bank_refuses_what_it_has_not();
    kinds_are_found();
    every_code_has_words();
    choices_go_by_name();
    the_type_of_the_array_chooses();
    return verdict("C");
}
