// What a peer in C++ shows to the harness: a table of variants, each of which makes filters that
// run over a record. Phi (samples, n), y (samples) and errors (samples) are of the filter's type.
#pragma once

struct Filter {
    virtual ~Filter() = default;
    // P = p0 I and theta = 0
    virtual void reset() = 0;
    virtual void run(long samples, const void* phi, const void* y, void* errors) = 0;
    virtual void theta(void* out) const = 0;
};

struct Variant {
    const char* name;
    // null where the variant does not exist for this size or type
    Filter* (*make)(long n, bool single, double lambda, double p0);
};

// defined by each peer; the table ends with a null name
extern const Variant variants[];
extern const char* const version;

extern "C" {
const char* peer_version() { return version; }

const char* variant_name(long index) { return variants[index].name; }

Filter* filter_make(long index, long n, bool single, double lambda, double p0) {
    return variants[index].make(n, single, lambda, p0);
}

void filter_reset(Filter* filter) { filter->reset(); }

void filter_run(Filter* filter, long samples, const void* phi, const void* y, void* errors) {
    filter->run(samples, phi, y, errors);
}

void filter_theta(const Filter* filter, void* out) { filter->theta(out); }

void filter_free(Filter* filter) { delete filter; }
}
