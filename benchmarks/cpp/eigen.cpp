// Recursive least squares with exponential forgetting as a good engineer writes it with Eigen:
// the covariance P itself (fast, but not safe: rounding makes it indefinite in the end), of fixed
// size up to 16 parameters, one triangle of it and a self-adjoint rank update above.
//
//     eigen <n> <record> <samples> <seconds>
//
// reads `samples` times n + 1 numbers (phi, then y) from the file `record` and prints the best
// time of a sample in nanoseconds and the sum of the final estimate.
#include <Eigen/Dense>
#include "harness.h"

template <int N>
struct Filter {
    using Vector = Eigen::Matrix<double, N, 1>;
    Eigen::Matrix<double, N, N> P;
    Vector theta, gain;

    explicit Filter(int n) : P(n, n), theta(n), gain(n) { reset(); }
    void reset() {
        P.setIdentity();
        P *= 100.0;
        theta.setZero();
    }
    double update(const double* phi_, double y) {
        const Eigen::Map<const Vector> phi(phi_, theta.size());
        const double lambda = 0.999;
        const double error = y - phi.dot(theta);
        if constexpr (N != Eigen::Dynamic) {
            gain.noalias() = P * phi;
            const double scale = 1.0 / (lambda + phi.dot(gain));
            theta.noalias() += gain * (scale * error);
            P.noalias() -= (gain * scale) * gain.transpose();
            P *= 1.0 / lambda;
        } else {
            gain.noalias() = P.template selfadjointView<Eigen::Lower>() * phi;
            const double scale = 1.0 / (lambda + phi.dot(gain));
            theta.noalias() += gain * (scale * error);
            P.template selfadjointView<Eigen::Lower>().rankUpdate(gain, -scale);
            P.template triangularView<Eigen::Lower>() *= 1.0 / lambda;
        }
        return error;
    }
    double sum() const { return theta.sum(); }
};

// Above 16 parameters: the scale by 1/lambda is kept aside, so that P is swept once less.
template <>
struct Filter<Eigen::Dynamic> {
    Eigen::MatrixXd P;
    Eigen::VectorXd theta, gain;
    double growth = 1.0;

    explicit Filter(int n) : P(n, n), theta(n), gain(n) { reset(); }
    void reset() {
        P.setIdentity();
        P *= 100.0;
        theta.setZero();
        growth = 1.0;
    }
    double update(const double* phi_, double y) {
        const Eigen::Map<const Eigen::VectorXd> phi(phi_, theta.size());
        const double lambda = 0.999;
        const double error = y - phi.dot(theta);
        growth /= lambda;
        gain.noalias() = P.selfadjointView<Eigen::Lower>() * phi;
        const double scale = growth / (1.0 + growth * phi.dot(gain));
        theta.noalias() += gain * (scale * error);
        P.selfadjointView<Eigen::Lower>().rankUpdate(gain, -scale);
        if (growth > 1e6) {
            P.triangularView<Eigen::Lower>() *= growth;
            growth = 1.0;
        }
        return error;
    }
    double sum() const { return theta.sum(); }
};

template <int N>
void fixed(int n, const Record& record) {
    if (n == N) {
        measure<Filter<N>>(n, record);
        return;
    }
    if constexpr (N > 1) fixed<N - 1>(n, record);
}

int main(int argc, char** argv) {
    const Record record(argc, argv);
    if (record.n <= 16) {
        fixed<16>(record.n, record);
    } else {
        measure<Filter<Eigen::Dynamic>>(record.n, record);
    }
}
