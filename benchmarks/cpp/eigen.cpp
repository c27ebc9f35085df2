// Recursive least squares with exponential forgetting in Eigen, written in each way that a good
// engineer would try. All keep P as a matrix and leave the division by lambda to one scalar:
//
//   P = s Q     h = Q phi     g = s / (lambda + s phi' h)
//   theta += g (y - phi' theta) h     Q -= g h h'     s *= 1 / lambda
#include <Eigen/Dense>
#include <algorithm>

#include "filter.h"

namespace {

using Eigen::Dynamic;
using Eigen::Lower;

template <typename T, int N> using Square = Eigen::Matrix<T, N, N>;
template <typename T, int N> using Column = Eigen::Matrix<T, N, 1>;
template <typename T, int N> using Regressor = Eigen::Map<const Column<T, N>>;

// The whole of Q: twice the arithmetic, but plain products. Rounding makes Q asymmetric, which grows
// by 1 / lambda a sample, so once in a while Q is made symmetric again.
struct Full {
    static constexpr bool halves = false;
    template <typename Q, typename V, typename X> static void multiply(const Q& q, V& h, const X& x) {
        h.noalias() = q * x;
    }
    template <typename Q, typename V, typename S> static void subtract(Q& q, const V& h, S g) {
        q.noalias() -= (g * h) * h.transpose();
    }
};

// As Full, each product written so that Eigen unrolls it instead of calling its kernels.
struct Unrolled {
    static constexpr bool halves = false;
    template <typename Q, typename V, typename X> static void multiply(const Q& q, V& h, const X& x) {
        h = q.lazyProduct(x);
    }
    template <typename Q, typename V, typename S> static void subtract(Q& q, const V& h, S g) {
        const V scaled = g * h;
        q -= scaled.lazyProduct(h.transpose());
    }
};

// The lower half of Q, by Eigen's own symmetric product and rank-one update.
struct Selfadjoint {
    static constexpr bool halves = true;
    template <typename Q, typename V, typename X> static void multiply(const Q& q, V& h, const X& x) {
        h.noalias() = q.template selfadjointView<Lower>() * x;
    }
    template <typename Q, typename V, typename S> static void subtract(Q& q, const V& h, S g) {
        q.template selfadjointView<Lower>().rankUpdate(h, -g);
    }
};

// The lower half of Q, column by column.
struct Columns {
    static constexpr bool halves = true;
    template <typename Q, typename V, typename X> static void multiply(const Q& q, V& h, const X& x) {
        const auto n = q.rows();
        h.setZero();
        for (Eigen::Index j = 0; j < n; ++j) {
            const auto below = n - j - 1;
            h.tail(below) += x[j] * q.col(j).tail(below);
            h[j] += q(j, j) * x[j] + q.col(j).tail(below).dot(x.tail(below));
        }
    }
    template <typename Q, typename V, typename S> static void subtract(Q& q, const V& h, S g) {
        const auto n = q.rows();
        for (Eigen::Index j = 0; j < n; ++j) q.col(j).tail(n - j) -= (g * h[j]) * h.tail(n - j);
    }
};

template <typename T> constexpr T LARGEST_SCALE = T(1e10);
constexpr long SYMMETRIC_EVERY = 1024;
// bytes of a panel of Q that stay in the first cache while it is updated and multiplied
constexpr Eigen::Index PANEL = 32768;

template <typename T, int N> struct State {
    Square<T, N> q;
    Column<T, N> theta, h;
    T s, lambda, growth, p0;

    State(long n, T lambda, T p0)
        : q(n, n), theta(n), h(n), lambda(lambda), growth(1 / lambda), p0(p0) {
        reset();
    }

    void reset() {
        q.setIdentity();
        q *= p0;
        theta.setZero();
        h.setZero();
        s = 1;
    }

    void symmetrize() { q.template triangularView<Eigen::StrictlyUpper>() = q.transpose(); }

    // long before s overflows, and so rarely that it costs nothing
    void rescale() {
        if (s > LARGEST_SCALE<T>) {
            q *= s;
            s = 1;
        }
    }
};

// Each sample reads Q for the product, then reads and writes it for the update.
template <typename T, int N, typename Form> struct TwoPasses final : Filter {
    State<T, N> state;

    TwoPasses(long n, T lambda, T p0) : state(n, lambda, p0) {}

    void reset() override { state.reset(); }

    T step(const Regressor<T, N>& x, T y) {
        auto& [q, theta, h, s, lambda, growth, p0] = state;
        Form::multiply(q, h, x);
        const T error = y - x.dot(theta);
        const T g = s / (lambda + s * x.dot(h));
        theta += (g * error) * h;
        Form::subtract(q, h, g);
        s *= growth;
        state.rescale();
        return error;
    }

    void run(long samples, const void* phi, const void* y, void* errors) override {
        const long n = state.theta.size();
        for (long k = 0; k < samples; ++k) {
            const Regressor<T, N> x(static_cast<const T*>(phi) + k * n, n);
            static_cast<T*>(errors)[k] = step(x, static_cast<const T*>(y)[k]);
            if (!Form::halves && k % SYMMETRIC_EVERY == 0) state.symmetrize();
        }
    }

    void theta(void* out) const override {
        Eigen::Map<Column<T, N>>(static_cast<T*>(out), state.theta.size()) = state.theta;
    }
};

// The update of a sample waits for the next regressor, and both go over the lower half of Q
// together, by panels of columns that stay in the first cache: Q is read and written once a sample.
// A panel's square on the diagonal is kept whole.
template <typename T, int N> struct OnePass final : Filter {
    State<T, N> state;
    Column<T, N> last;
    T pending = 0; // Q + pending last last' is the Q of above

    OnePass(long n, T lambda, T p0) : state(n, lambda, p0), last(n) { reset(); }

    void reset() override {
        state.reset();
        last.setZero();
        pending = 0;
    }

    void sweep(const Regressor<T, N>& x) {
        auto& [q, theta, h, s, lambda, growth, p0] = state;
        const auto n = q.rows();
        h.setZero();
        const auto widest = std::clamp<Eigen::Index>(PANEL / (n * sizeof(T)), 4, 16);
        for (Eigen::Index j = 0; j < n; j += widest) {
            const auto width = std::min(widest, n - j), below = n - j - width;
            auto panel = q.block(j, j, n - j, width);
            panel.noalias() += (pending * last.tail(n - j)) * last.segment(j, width).transpose();
            h.tail(n - j).noalias() += panel * x.segment(j, width);
            h.segment(j, width).noalias() += panel.bottomRows(below).transpose() * x.tail(below);
        }
    }

    T step(const Regressor<T, N>& x, T y) {
        sweep(x);
        auto& [q, theta, h, s, lambda, growth, p0] = state;
        const T error = y - x.dot(theta);
        const T g = s / (lambda + s * x.dot(h));
        theta += (g * error) * h;
        last.swap(h);
        pending = -g;
        s *= growth;
        if (s > LARGEST_SCALE<T>) pending *= s;
        state.rescale();
        return error;
    }

    void run(long samples, const void* phi, const void* y, void* errors) override {
        const long n = state.theta.size();
        for (long k = 0; k < samples; ++k) {
            const Regressor<T, N> x(static_cast<const T*>(phi) + k * n, n);
            static_cast<T*>(errors)[k] = step(x, static_cast<const T*>(y)[k]);
            if (k % SYMMETRIC_EVERY == 0) state.symmetrize();
        }
    }

    void theta(void* out) const override {
        Eigen::Map<Column<T, N>>(static_cast<T*>(out), state.theta.size()) = state.theta;
    }
};

template <template <typename, int> class Kind, int N>
Filter* sized(long n, bool single, double lambda, double p0) {
    if (single) return new Kind<float, N>(n, float(lambda), float(p0));
    return new Kind<double, N>(n, lambda, p0);
}

// the sizes that are timed, up to LARGEST
template <template <typename, int> class Kind, int LARGEST>
Filter* fixed(long n, bool single, double lambda, double p0) {
    switch (n) {
        case 2: return sized<Kind, 2>(n, single, lambda, p0);
        case 4: return sized<Kind, 4>(n, single, lambda, p0);
        case 6: return sized<Kind, 6>(n, single, lambda, p0);
        case 10: return sized<Kind, 10>(n, single, lambda, p0);
        case 16: return sized<Kind, 16>(n, single, lambda, p0);
    }
    if constexpr (LARGEST > 16) {
        if (n == 32) return sized<Kind, 32>(n, single, lambda, p0);
        if (n == 64) return sized<Kind, 64>(n, single, lambda, p0);
    }
    return nullptr;
}

template <typename T, int N> using TwoPassesFull = TwoPasses<T, N, Full>;
template <typename T, int N> using TwoPassesUnrolled = TwoPasses<T, N, Unrolled>;
template <typename T, int N> using TwoPassesSelfadjoint = TwoPasses<T, N, Selfadjoint>;
template <typename T, int N> using TwoPassesColumns = TwoPasses<T, N, Columns>;

} // namespace

#define TEXT(word) #word
#define DOTTED(a, b, c) TEXT(a) "." TEXT(b) "." TEXT(c)
const char* const version =
    "Eigen " DOTTED(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);

const Variant variants[] = {
    // the other forms were slower at these sizes where tried, and take long to compile
    {"fixed size, full", fixed<TwoPassesFull, 64>},
    {"fixed size, full, unrolled", fixed<TwoPassesUnrolled, 16>},
    {"fixed size, selfadjointView", fixed<TwoPassesSelfadjoint, 64>},
    {"dynamic, full", sized<TwoPassesFull, Dynamic>},
    {"dynamic, selfadjointView", sized<TwoPassesSelfadjoint, Dynamic>},
    {"dynamic, columns", sized<TwoPassesColumns, Dynamic>},
    {"dynamic, one pass", sized<OnePass, Dynamic>},
    {nullptr, nullptr},
};
