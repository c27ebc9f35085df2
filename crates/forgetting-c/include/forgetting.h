/*
 * forgetting: recursive least squares with generalized forgetting.
 *
 * Follows the parameters theta (n numbers) of y = phi theta + noise, sample by sample, and forgets old
 * samples where new ones have taken their place. P (n x n) is the covariance of theta in units of the
 * variance of the noise.
 *
 *   static max_align_t memory[64];                         // at least fg_size(kind) bytes
 *   fg_settings settings = {.parameters = 2, .initial_covariance = 100, .forgetting_factor = 0.98};
 *   fg_estimator *estimator;
 *   if (fg_init(memory, sizeof memory, &fg_subspace_f32_2, &settings, &estimator, NULL) == FG_OK)
 *       fg_update_f32(estimator, (float[]){1, 3}, 2, 5, NULL);
 *
 * Memory is the caller's: nothing is allocated, and nothing has to be freed. There are no global
 * variables. Different estimators may be used by different threads at the same time, one estimator by one
 * thread at a time. An estimator may not be moved or copied byte by byte while it is used by another
 * thread; it holds no pointer into itself, so that it may be copied otherwise.
 *
 * Every function that can refuse returns a code, FG_OK (0) if it did what it says. What was refused has
 * changed nothing. A sample that is left out, or P that has wound up, is no error: the report says so.
 *
 * Licence: MIT or Apache-2.0.
 */
#ifndef FORGETTING_H
#define FORGETTING_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Codes. */
enum {
    FG_OK = 0,
    FG_ERROR_NULL = 1,             /* a pointer is null that must not be */
    FG_ERROR_MEMORY = 2,           /* the memory is too short */
    FG_ERROR_ALIGNMENT = 3,        /* the memory does not begin at a multiple of fg_alignment */
    FG_ERROR_NOT_AN_ESTIMATOR = 4, /* the memory holds no estimator */
    FG_ERROR_NUMBER_TYPE = 5,      /* the estimator computes with the other type of number */
    FG_ERROR_VALUE = 6,            /* a value is out of its range, or not finite */
    FG_ERROR_LENGTH = 7,           /* a number of elements is not the one needed */
    FG_ERROR_INDEFINITE = 8,       /* a matrix is not positive definite */
    FG_ERROR_MISSING = 9,          /* a parameter must be given */
    FG_ERROR_UNKNOWN = 10,         /* a name is not known */
    FG_ERROR_RANGE = 11,           /* a quantity would leave the range of the number type */
    FG_ERROR_UNSUPPORTED = 12,     /* choices do not go together */
    FG_ERROR_STATE = 13            /* bytes are not a saved estimator of this kind */
};

/* The type of all numbers of an estimator. */
enum { FG_F32 = 4, FG_F64 = 8 };

/* A type of estimator: number type, size, rule. */
typedef struct fg_kind fg_kind;

/* An estimator, in the memory that it was made in. */
typedef struct fg_estimator fg_estimator;

/* Text that is not ended by a zero: printf("%.*s", (int)text.length, text.text). */
typedef struct fg_text {
    const char *text;
    size_t length;
} fg_text;

/* What was refused. */
typedef struct fg_why {
    int32_t code;      /* what the function returns, too */
    int32_t index;     /* position in the parameter, or -1 */
    double value;      /* the value given, or NaN */
    fg_text parameter; /* its name, or nothing */
    fg_text allowed;   /* what is allowed, or what is wrong, in words; or nothing */
} fg_why;

/* A parameter of a rule, a rate, a weighting or a gate. */
typedef struct fg_parameter {
    const char *name;
    double number;    /* its value, where there is no word */
    const char *word; /* its value as a word, or null */
} fg_parameter;

/* A rule, a rate, a weighting or a gate by its name, with parameters; those not given have their
 * defaults. Names, ranges and defaults are those of `forgetting rules` and of the documentation. */
typedef struct fg_choice {
    const char *name;               /* null for the default */
    const fg_parameter *parameters; /* count of them */
    size_t count;
} fg_choice;

/* What an estimator is made from. All zeros but for `parameters` is what Python's RLS(n) is, for a
 * general kind, and Python's Bank(n), for a bank; a compact kind needs an initial covariance. A bank takes
 * an initial covariance, an initial theta together with it, and nothing else. */
typedef struct fg_settings {
    size_t parameters;           /* n, one of those that the kind is for */
    fg_choice rule;              /* where to forget; compact kinds: the name is that of the kind or null */
    fg_choice rate;              /* how much to forget, in the place of forgetting_factor */
    fg_choice weighting;         /* how far to trust a sample; equally */
    fg_choice gate;              /* whether a sample is used; always */
    double forgetting_factor;    /* lambda in (0, 1]; 0 for 0.99, or for none where the rule uses none */
    double initial_covariance;   /* c > 0 of P0 = c I, in units of 1/phi^2; 0 where it follows the data */
    const double *initial_theta; /* theta0, n finite numbers; null for 0 */
    int32_t monitor;             /* other than 0: watch windup, excitation and noise, see fg_health */
} fg_settings;

/* What became of a sample, for each type of number. */
typedef struct fg_report_f32 {
    float error;             /* y - phi theta, with the theta of before */
    float leverage;          /* phi P phi', after forgetting and before the sample; >= 0 */
    float forgetting_factor; /* lambda of this sample */
    float weight;            /* of the weighting, 1 without one */
    uint8_t used;            /* 1 if it was learned from, 0 if it was left out */
    uint8_t windup;          /* 1 if P has wound up */
    uint8_t gate;            /* 0 update, 1 freeze (learn, forget nothing), 2 hold (left out) */
    uint8_t reserved;
} fg_report_f32;

typedef struct fg_report_f64 {
    double error;
    double leverage;
    double forgetting_factor;
    double weight;
    uint8_t used;
    uint8_t windup;
    uint8_t gate;
    uint8_t reserved;
} fg_report_f64;

/* What a monitor has found. */
typedef struct fg_health_report {
    uint64_t samples;        /* monitored */
    uint64_t since_informed; /* samples since the direction of which least is known was last informed */
    double variance;         /* in P along that direction */
    double growth;           /* that over what it was when the direction was last informed; 1 while it is */
    double noise_variance;   /* estimated; NaN before the first sample */
    double correlation;      /* of each error with the one before, in [-1, 1] */
    double weight;           /* samples behind noise_variance and correlation */
    uint8_t windup;          /* 1 if that direction has wound up */
    uint8_t informed;        /* 1 if it is informed now */
    uint8_t reserved[6];
} fg_health_report;

/* How many members a bank has. */
#define FG_BANK_MEMBERS 8

/*
 * Kinds.
 *
 * Compact kinds: one rule, n parameters, lambda the same for every sample, P0 = c I. They are small and
 * need no more memory than the numbers that they keep. A program links those that it names.
 * Banks: compact random walks of eight speeds on the same samples, weighed by how well each has predicted
 * (the mixer mlpol). Nothing need be chosen, and no unit matters where no initial covariance is given.
 * General kinds: any rule, rate, weighting and gate by name, 1 to 8 or (double)
 * 1 to 32 parameters; for desktops.
 * All give the bits of Python for the same settings and arithmetic.
 */
#define FG_COMPACT_KINDS(rule)                                                                          \
    extern const fg_kind fg_##rule##_f32_1, fg_##rule##_f32_2, fg_##rule##_f32_3, fg_##rule##_f32_4,    \
        fg_##rule##_f32_5, fg_##rule##_f32_6, fg_##rule##_f32_7, fg_##rule##_f32_8, fg_##rule##_f64_1,  \
        fg_##rule##_f64_2, fg_##rule##_f64_3, fg_##rule##_f64_4, fg_##rule##_f64_5, fg_##rule##_f64_6,  \
        fg_##rule##_f64_7, fg_##rule##_f64_8
FG_COMPACT_KINDS(none);        /* forgets nothing */
FG_COMPACT_KINDS(exponential); /* everything at the same rate; may wind up */
FG_COMPACT_KINDS(subspace);    /* in the direction of phi only; cannot wind up; parameter threshold */
FG_COMPACT_KINDS(directional); /* the same, with another dead zone; parameter threshold */
FG_COMPACT_KINDS(random_walk); /* every parameter walks alike; parameters process_noise, bound */
FG_COMPACT_KINDS(bank);        /* the default bank */

extern const fg_kind fg_general_f32_8, fg_general_f64_8, fg_general_f64_32;

/* The compact kind of a rule, or of the "bank", for n parameters, or the smallest general kind where `rule` is null; `number`
 * is FG_F32 or FG_F64. Null if there is none. It links all kinds. */
const fg_kind *fg_find(const char *rule, int32_t number, size_t parameters);

/* The bytes that an estimator of this kind takes, and what its address must be a multiple of (a power of
 * two); 0 for null. */
size_t fg_size(const fg_kind *kind);
size_t fg_alignment(const fg_kind *kind);

/* Makes an estimator in `size` bytes of `memory`; `*estimator` (unless null) then is that memory.
 * `why` (unless null) is told what was refused.
 * Errors: NULL, MEMORY, ALIGNMENT, VALUE, LENGTH, MISSING, UNKNOWN, UNSUPPORTED, INDEFINITE. */
int32_t fg_init(void *memory, size_t size, const fg_kind *kind, const fg_settings *settings,
                fg_estimator **estimator, fg_why *why);

/* Takes a sample: n numbers phi and y. `report` may be null.
 * Errors: NULL, ALIGNMENT, NOT_AN_ESTIMATOR, NUMBER_TYPE; LENGTH if n is another; VALUE for a number that
 * is not finite; RANGE for one that is too large, or where P would become too large. */
int32_t fg_update_f32(fg_estimator *estimator, const float *phi, size_t n, float y,
                      fg_report_f32 *report);
int32_t fg_update_f64(fg_estimator *estimator, const double *phi, size_t n, double y,
                      fg_report_f64 *report);

/* The same of a sample that comes `elapsed` after the last one, in any unit of time: lambda^elapsed, at
 * least 1/1024, takes the place of lambda, and process noise counts so many times; fg_update takes one
 * unit. `gamma` is the variance of its noise, in units of that of the others, which have 1; null if it is
 * not known. So a sample of weight w has gamma = 1/w.
 * Errors: as fg_update; VALUE for a time below 0, and for a variance that is not positive. */
int32_t fg_update_after_f32(fg_estimator *estimator, float elapsed, const float *phi, size_t n, float y,
                            const float *gamma, fg_report_f32 *report);
int32_t fg_update_after_f64(fg_estimator *estimator, double elapsed, const double *phi, size_t n, double y,
                            const double *gamma, fg_report_f64 *report);

/* phi theta of n numbers phi. Errors: as fg_update, but for VALUE and RANGE. */
int32_t fg_predict_f32(fg_estimator *estimator, const float *phi, size_t n, float *prediction);
int32_t fg_predict_f64(fg_estimator *estimator, const double *phi, size_t n, double *prediction);

/* theta, n numbers. Errors: as fg_predict. */
int32_t fg_theta_f32(fg_estimator *estimator, float *theta, size_t n);
int32_t fg_theta_f64(fg_estimator *estimator, double *theta, size_t n);

/* Goes on from these n numbers theta; P stays as it is.
 * Errors: as fg_predict; UNSUPPORTED for a bank, of which each member has a theta; VALUE for a number that is not finite, or larger than the root of the largest. */
int32_t fg_set_theta_f32(fg_estimator *estimator, const float *theta, size_t n);
int32_t fg_set_theta_f64(fg_estimator *estimator, const double *theta, size_t n);

/* theta (n numbers) within lower <= theta <= upper, n numbers each, -INFINITY and INFINITY where there is no
 * bound, null where there is none at all: the point of that box that is nearest in the metric of the
 * inverse of P. If the true parameters are inside, the error in that metric is at most that of fg_theta.
 * The estimator is as it was; fg_set_theta goes on from the result. It computes in double, takes 2 kB of
 * stack up to 8 parameters and 30 kB above, and is Python's `bounded`.
 * Errors: as fg_predict; VALUE where a lower bound is above the upper one, or is not a number; INDEFINITE
 * for a P that is singular to rounding. What `theta` points to is then as it was. */
int32_t fg_bounded_f32(fg_estimator *estimator, const float *lower, const float *upper, size_t n,
                       float *theta);
int32_t fg_bounded_f64(fg_estimator *estimator, const double *lower, const double *upper, size_t n,
                       double *theta);

/* P, n x n numbers, in units of 1/phi^2: times the variance of the noise, the covariance of theta. That of
 * a bank is that of the mixture, with what the members disagree about.
 * Errors: as fg_predict. */
int32_t fg_covariance_f32(fg_estimator *estimator, float *covariance, size_t n);
int32_t fg_covariance_f64(fg_estimator *estimator, double *covariance, size_t n);

/* How far each member of a bank is believed, `members` = FG_BANK_MEMBERS numbers, from the slowest walk to
 * the fastest: not negative, their sum is 1.
 * Errors: NULL, ALIGNMENT, NOT_AN_ESTIMATOR, NUMBER_TYPE; UNSUPPORTED for what is no bank; LENGTH if `members`
 * is another number. */
int32_t fg_weights_f32(fg_estimator *estimator, float *weights, size_t members);
int32_t fg_weights_f64(fg_estimator *estimator, double *weights, size_t members);

/* fg_update, fg_update_after, fg_predict, fg_theta, fg_set_theta, fg_bounded, fg_covariance and fg_weights:
 * whichever of the two the type of the array says. */
#if !defined(__cplusplus) && defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L
#define FG_OF_TYPE(array, function)                                                   \
    _Generic((array), float *: function##_f32, const float *: function##_f32,         \
        double *: function##_f64, const double *: function##_f64)
#define fg_update(estimator, phi, n, y, report) FG_OF_TYPE(phi, fg_update)(estimator, phi, n, y, report)
#define fg_update_after(estimator, elapsed, phi, n, y, gamma, report) \
    FG_OF_TYPE(phi, fg_update_after)(estimator, elapsed, phi, n, y, gamma, report)
#define fg_predict(estimator, phi, n, prediction) FG_OF_TYPE(phi, fg_predict)(estimator, phi, n, prediction)
#define fg_theta(estimator, theta, n) FG_OF_TYPE(theta, fg_theta)(estimator, theta, n)
#define fg_set_theta(estimator, theta, n) FG_OF_TYPE(theta, fg_set_theta)(estimator, theta, n)
#define fg_bounded(estimator, lower, upper, n, theta) FG_OF_TYPE(theta, fg_bounded)(estimator, lower, upper, n, theta)
#define fg_covariance(estimator, covariance, n) FG_OF_TYPE(covariance, fg_covariance)(estimator, covariance, n)
#define fg_weights(estimator, weights, members) FG_OF_TYPE(weights, fg_weights)(estimator, weights, members)
#endif

/* What the monitor has found. Errors: NULL, ALIGNMENT, NOT_AN_ESTIMATOR; UNSUPPORTED without a monitor, which
 * a bank never has. */
int32_t fg_health(fg_estimator *estimator, fg_health_report *health);

/* Samples used so far; 0 if there is no estimator. */
uint64_t fg_samples(fg_estimator *estimator);

/* Back to theta0 and P0. Errors: NULL, ALIGNMENT, NOT_AN_ESTIMATOR. */
int32_t fg_reset(fg_estimator *estimator);

/* Saves the estimator, configuration and state, as the bytes that Python's to_bytes writes. `*length`
 * becomes their number. Where `bytes` is null nothing else is done. Nothing of the estimator changes.
 * Errors: NULL, ALIGNMENT, NOT_AN_ESTIMATOR; MEMORY if `capacity` is less than the length. */
int32_t fg_save(fg_estimator *estimator, void *bytes, size_t capacity, size_t *length);

/* Makes the estimator that was saved as `length` bytes, here or by Python's to_bytes. It goes on bit for
 * bit. Errors: as fg_init; STATE for bytes that were altered, or are not those of an estimator of this
 * kind. `memory` is as it was then. */
int32_t fg_load(void *memory, size_t size, const fg_kind *kind, const void *bytes, size_t length,
                fg_estimator **estimator, fg_why *why);

/* A code in words; never null. */
const char *fg_strerror(int32_t code);

/* Changes when a program must be compiled again. */
#define FG_ABI_VERSION 1
uint32_t fg_abi_version(void);

#ifdef __cplusplus
}
#endif

#endif
