// dlib::rls, as its documentation shows it: train on one column vector after another.
#include <dlib/algs.h>
#include <dlib/revision.h>
#include <dlib/test_for_odr_violations.h>
#ifdef OWN_LOOPS // instead of the BLAS that the package was configured with
#undef DLIB_USE_BLAS
#undef DLIB_USE_LAPACK
#endif
#include <dlib/svm/rls.h>

#include "filter.h"

namespace {

struct Dlib final : Filter {
    long n;
    double lambda, p0;
    bool prior_forgotten;
    dlib::rls filter;
    dlib::matrix<double, 0, 1> x;

    Dlib(long n, double lambda, double p0, bool prior_forgotten)
        : n(n), lambda(lambda), p0(p0), prior_forgotten(prior_forgotten), x(n) {
        reset();
    }

    void reset() override { filter = dlib::rls(lambda, p0, prior_forgotten); }

    void run(long samples, const void* phi, const void* y, void* errors) override {
        for (long k = 0; k < samples; ++k) {
            x = dlib::mat(static_cast<const double*>(phi) + k * n, n);
            const double target = static_cast<const double*>(y)[k];
            // before the first sample its estimate has no size
            const bool first = filter.get_w().size() == 0;
            static_cast<double*>(errors)[k] = first ? target : target - filter(x);
            filter.train(x, target);
        }
    }

    void theta(void* out) const override {
        for (long i = 0; i < n; ++i) static_cast<double*>(out)[i] = filter.get_w()(i);
    }
};

template <bool prior_forgotten> Filter* make(long n, bool single, double lambda, double p0) {
    return single ? nullptr : new Dlib(n, lambda, p0, prior_forgotten);
}

} // namespace

#define TEXT(word) #word
#define DOTTED(a, b, c) TEXT(a) "." TEXT(b) "." TEXT(c)
const char* const version = "dlib " DOTTED(DLIB_MAJOR_VERSION, DLIB_MINOR_VERSION, DLIB_PATCH_VERSION);

const Variant variants[] = {
    // the prior is forgotten too: exponential forgetting
    {"C forgotten", make<true>},
    // the prior stays alive: O(n^3) a sample
    {"default", make<false>},
    {nullptr, nullptr},
};
