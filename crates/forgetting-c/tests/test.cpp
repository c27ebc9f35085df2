// The library through forgetting.hpp.
#include "check.h"
#include <cmath>
#include <forgetting.hpp>
#include <type_traits>
#include <utility>

namespace {

template <class T> void follows_a_line(fg::Estimator<T> estimator) {
    for (int k = 0; k < 100; ++k) {
        T x = static_cast<T>(k % 7);
        auto report = estimator.update({T(1), x}, T(3) + T(0.5) * x);
        CHECK(report.used == 1);
    }
    auto theta = estimator.theta();
    CHECK(std::abs(theta[0] - T(3)) < T(1e-3) && std::abs(theta[1] - T(0.5)) < T(1e-3));
    CHECK(std::abs(estimator.predict({T(1), T(2)}) - T(4)) < T(1e-2));
    CHECK(estimator.covariance().size() == 4 && estimator.samples() == 100);
    CHECK(estimator.parameters() == 2);
    fg::Estimator<T> moved = std::move(estimator);
    CHECK(moved.theta() == theta);
    moved.reset();
    CHECK(moved.samples() == 0);
}

template <class Work> void is_refused(int32_t code, const char *word, Work work) {
    try {
        work();
        CHECK(!"refused");
    } catch (const fg::Error &error) {
        CHECK(error.code() == code);
        CHECK(std::string(error.what()).find(word) != std::string::npos);
    }
}

fg::Settings usual() { return fg::Settings(2).forgetting_factor(0.98).initial_covariance(1e4); }

void in_time_and_within_bounds() {
    auto made = [] { return fg::Estimator<double>(usual(), &fg_exponential_f64_2); };
    fg::Estimator<double> plain = made(), timed = made();
    for (int k = 0; k < 20; ++k) {
        std::vector<double> phi = {1, std::sin(k)};
        plain.update(phi, 3 - phi[1]);
        timed.update_after(1, phi, 3 - phi[1], 1);
    }
    CHECK(plain.to_bytes() == timed.to_bytes());
    auto report = timed.update_after(2, {1.0, 0.5}, 3.0);
    CHECK(std::abs(report.forgetting_factor - 0.98 * 0.98) < 1e-15);
    auto inside = plain.bounded({2.0, -0.5}, {});
    CHECK(inside[1] == -0.5 && inside[0] >= 2);
    CHECK(plain.bounded({}, {}) == plain.theta());
    plain.set_theta(inside);
    CHECK(plain.theta() == inside);
    is_refused(FG_ERROR_LENGTH, "bounds", [&] { plain.bounded({1.0}, {}); });
    is_refused(FG_ERROR_VALUE, "range", [&] { plain.bounded({1.0, 1.0}, {0.0, 2.0}); });
    is_refused(FG_ERROR_VALUE, "range", [&] { timed.update_after(-1, {1.0, 0.5}, 3.0); });
    is_refused(FG_ERROR_VALUE, "range", [&] { timed.update_after(1, {1.0, 0.5}, 3.0, 0); });
    is_refused(FG_ERROR_LENGTH, "elements", [&] { plain.set_theta({1.0}); });
}

void saved() {
    fg::Estimator<double> estimator(usual().rule("subspace", {{"threshold", 1e-3}}));
    estimator.update({1.0, 2.0}, 3.0);
    auto bytes = estimator.to_bytes();
    auto loaded = fg::Estimator<double>::from_bytes(bytes, 2);
    CHECK(loaded.theta() == estimator.theta());
    is_refused(FG_ERROR_LENGTH, "elements", [&] { fg::Estimator<double>::from_bytes(bytes, 3); });
    bytes[40] ^= 1;
    is_refused(FG_ERROR_STATE, "altered", [&] { fg::Estimator<double>::from_bytes(bytes, 2); });
}

void a_bank() {
    follows_a_line(fg::Estimator<float>(fg::Settings(2), &fg_bank_f32_2));
    fg::Estimator<double> bank(fg::Settings(2), &fg_bank_f64_2);
    bank.update({1.0, 2.0}, 3.0);
    const std::vector<double> weights = bank.weights();
    CHECK(weights.size() == FG_BANK_MEMBERS);
    for (std::size_t i = 1; i < weights.size(); ++i) CHECK(std::fabs(weights[i] / weights[i - 1] - 0.93) < 1e-14);
    auto loaded = fg::Estimator<double>::from_bytes(bank.to_bytes(), 2, &fg_bank_f64_2);
    CHECK(loaded.theta() == bank.theta());
    is_refused(FG_ERROR_UNSUPPORTED, "rule",
               [] { fg::Estimator<double>(fg::Settings(2).rule("subspace"), &fg_bank_f64_2); });
    is_refused(FG_ERROR_UNSUPPORTED, "supported", [] { fg::Estimator<double>(usual()).weights(); });
}

} // namespace

int main() {
    static_assert(!std::is_copy_constructible_v<fg::Estimator<float>>);
    static_assert(std::is_nothrow_move_constructible_v<fg::Estimator<float>>);
    follows_a_line(fg::Estimator<double>(usual()));
    follows_a_line(fg::Estimator<float>(usual()));
    follows_a_line(fg::Estimator<float>(usual(), &fg_subspace_f32_2));
    follows_a_line(fg::Estimator<double>(usual().rule("exponential").rate("constant")
                                             .gate("open").weighting("equal").initial_theta({1, 1})));
    saved();
    a_bank();
    in_time_and_within_bounds();
    fg::Estimator<double> monitored(usual().monitor());
    monitored.update({1.0, 2.0}, 3.0);
    CHECK(monitored.health().samples == 1);
    is_refused(FG_ERROR_VALUE, "forgetting_factor", [] { fg::Estimator<double>(usual().forgetting_factor(2)); });
    is_refused(FG_ERROR_UNKNOWN, "rule", [] { fg::Estimator<double>(usual().rule("nothing")); });
    is_refused(FG_ERROR_VALUE, "no kind", [] { fg::Estimator<double>(fg::Settings(99)); });
    is_refused(FG_ERROR_LENGTH, "elements", [&] { monitored.update({1.0}, 3.0); });
    is_refused(FG_ERROR_LENGTH, "initial_theta", [] { fg::Estimator<double>(usual().initial_theta({1})); });
#ifdef FORGETTING_HAS_SPAN
    const double phi[] = {1, 2};
    CHECK(monitored.update(std::span<const double>(phi), 3.0).used == 1);
    return verdict("C++20");
#else
    return verdict("C++17");
#endif
}
