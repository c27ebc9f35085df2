// forgetting for C++17: the functions of forgetting.h with types, RAII and exceptions.
//
//   fg::Estimator<double> estimator(fg::Settings(2).rule("subspace", {{"threshold", 1e-3}})
//                                       .forgetting_factor(0.98).initial_covariance(100));
//   auto report = estimator.update({1.0, 3.0}, 5.0);
//
// What the library refuses is an fg::Error with the code and the words of forgetting.h.
#ifndef FORGETTING_HPP
#define FORGETTING_HPP

#include "forgetting.h"

#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#if defined(__has_include) && __cplusplus >= 202002L
#if __has_include(<span>)
#include <span>
#define FORGETTING_HAS_SPAN 1
#endif
#endif

namespace fg {

/// A refusal.
class Error : public std::runtime_error {
  public:
    Error(int32_t code, const std::string &what) : std::runtime_error(what), code_(code) {}
    /// One of FG_ERROR_...
    int32_t code() const noexcept { return code_; }

  private:
    int32_t code_;
};

namespace detail {

inline std::string words(const fg_text &text) { return std::string(text.text, text.length); }

inline void check(int32_t code) {
    if (code != FG_OK) throw Error(code, fg_strerror(code));
}

inline void check(int32_t code, const fg_why &why) {
    if (code == FG_OK) return;
    std::string what = fg_strerror(code);
    if (why.parameter.length) what += ": " + words(why.parameter);
    if (why.value == why.value) what += " = " + std::to_string(why.value);
    if (why.allowed.length) what += ", " + words(why.allowed);
    throw Error(code, what);
}

template <class T> struct Functions;

template <> struct Functions<float> {
    static constexpr int32_t number = FG_F32;
    using Report = fg_report_f32;
    static constexpr auto update = fg_update_f32;
    static constexpr auto update_after = fg_update_after_f32;
    static constexpr auto predict = fg_predict_f32;
    static constexpr auto theta = fg_theta_f32;
    static constexpr auto set_theta = fg_set_theta_f32;
    static constexpr auto bounded = fg_bounded_f32;
    static constexpr auto covariance = fg_covariance_f32;
    static constexpr auto weights = fg_weights_f32;
};

template <> struct Functions<double> {
    static constexpr int32_t number = FG_F64;
    using Report = fg_report_f64;
    static constexpr auto update = fg_update_f64;
    static constexpr auto update_after = fg_update_after_f64;
    static constexpr auto predict = fg_predict_f64;
    static constexpr auto theta = fg_theta_f64;
    static constexpr auto set_theta = fg_set_theta_f64;
    static constexpr auto bounded = fg_bounded_f64;
    static constexpr auto covariance = fg_covariance_f64;
    static constexpr auto weights = fg_weights_f64;
};

} // namespace detail

/// A parameter: a name with a number or a word.
struct Parameter {
    Parameter(std::string name, double number) : name(std::move(name)), number(number) {}
    Parameter(std::string name, std::string word)
        : name(std::move(name)), number(0), word(std::move(word)), is_word(true) {}
    Parameter(std::string name, const char *word) : Parameter(std::move(name), std::string(word)) {}
    std::string name;
    double number;
    std::string word;
    bool is_word = false;
};

/// What an estimator is made from; what is not said is as in forgetting.h.
class Settings {
  public:
    using Parameters = std::vector<Parameter>;
    explicit Settings(std::size_t parameters) { plain_.parameters = parameters; }

    Settings &rule(std::string name, Parameters p = {}) { return choose(rule_, std::move(name), std::move(p)); }
    Settings &rate(std::string name, Parameters p = {}) { return choose(rate_, std::move(name), std::move(p)); }
    Settings &weighting(std::string name, Parameters p = {}) {
        return choose(weighting_, std::move(name), std::move(p));
    }
    Settings &gate(std::string name, Parameters p = {}) { return choose(gate_, std::move(name), std::move(p)); }
    Settings &forgetting_factor(double lambda) { return plain_.forgetting_factor = lambda, *this; }
    Settings &initial_covariance(double c) { return plain_.initial_covariance = c, *this; }
    Settings &initial_theta(std::vector<double> theta) { return theta_ = std::move(theta), *this; }
    Settings &monitor(bool on = true) { return plain_.monitor = on, *this; }

  private:
    template <class> friend class Estimator;

    struct Choice {
        std::string name;
        Parameters given;
        std::vector<fg_parameter> plain;
        fg_choice view() {
            if (name.empty()) return {};
            plain.clear();
            for (const Parameter &p : given)
                plain.push_back({p.name.c_str(), p.number, p.is_word ? p.word.c_str() : nullptr});
            return {name.c_str(), plain.data(), plain.size()};
        }
    };

    Settings &choose(Choice &choice, std::string name, Parameters given) {
        choice = {std::move(name), std::move(given), {}};
        return *this;
    }

    const fg_settings &view() {
        if (!theta_.empty() && theta_.size() != plain_.parameters)
            throw Error(FG_ERROR_LENGTH, "initial_theta has another number of elements than parameters");
        plain_.initial_theta = theta_.empty() ? nullptr : theta_.data();
        plain_.rule = rule_.view();
        plain_.rate = rate_.view();
        plain_.weighting = weighting_.view();
        plain_.gate = gate_.view();
        return plain_;
    }

    fg_settings plain_{};
    Choice rule_, rate_, weighting_, gate_;
    std::vector<double> theta_;
};

/// An estimator that computes with `float` or `double`.
template <class T> class Estimator {
    using F = detail::Functions<T>;

  public:
    using Report = typename F::Report;

    /// Of the smallest general kind that fits.
    explicit Estimator(Settings settings) : Estimator(std::move(settings), nullptr) {}

    /// Of this kind.
    Estimator(Settings settings, const fg_kind *kind) {
        const fg_settings &view = settings.view();
        take(kind ? kind : fg_find(nullptr, F::number, view.parameters));
        fg_why why;
        detail::check(fg_init(memory_.get(), fg_size(kind_), kind_, &view, &estimator_, &why), why);
        parameters_ = view.parameters;
    }

    /// The one of n = `parameters` that was saved as these bytes, of a general kind if none is given.
    static Estimator from_bytes(const std::vector<unsigned char> &bytes, std::size_t parameters,
                                const fg_kind *kind = nullptr) {
        Estimator made;
        made.take(kind ? kind : fg_find(nullptr, F::number, parameters));
        made.parameters_ = parameters;
        fg_why why;
        detail::check(fg_load(made.memory_.get(), fg_size(made.kind_), made.kind_, bytes.data(),
                              bytes.size(), &made.estimator_, &why),
                      why);
        // refuses another number of parameters
        made.theta();
        return made;
    }

    Estimator(Estimator &&other) noexcept = default;
    Estimator &operator=(Estimator &&other) noexcept = default;
    Estimator(const Estimator &) = delete;
    Estimator &operator=(const Estimator &) = delete;

    /// Takes a sample of n numbers.
    Report update(const T *phi, std::size_t n, T y) {
        Report report;
        detail::check(F::update(estimator_, phi, n, y, &report));
        return report;
    }
    Report update(const std::vector<T> &phi, T y) { return update(phi.data(), phi.size(), y); }
    Report update(std::initializer_list<T> phi, T y) { return update(phi.begin(), phi.size(), y); }

    /// Takes a sample of n numbers that comes `elapsed` after the last one.
    Report update_after(T elapsed, const T *phi, std::size_t n, T y) {
        return take(elapsed, phi, n, y, nullptr);
    }
    /// The same, the variance of its noise being `gamma`.
    Report update_after(T elapsed, const T *phi, std::size_t n, T y, T gamma) {
        return take(elapsed, phi, n, y, &gamma);
    }
    Report update_after(T elapsed, const std::vector<T> &phi, T y) {
        return update_after(elapsed, phi.data(), phi.size(), y);
    }
    Report update_after(T elapsed, const std::vector<T> &phi, T y, T gamma) {
        return update_after(elapsed, phi.data(), phi.size(), y, gamma);
    }

    /// phi theta
    T predict(const T *phi, std::size_t n) const {
        T prediction;
        detail::check(F::predict(estimator_, phi, n, &prediction));
        return prediction;
    }
    T predict(const std::vector<T> &phi) const { return predict(phi.data(), phi.size()); }
    T predict(std::initializer_list<T> phi) const { return predict(phi.begin(), phi.size()); }

#ifdef FORGETTING_HAS_SPAN
    Report update(std::span<const T> phi, T y) { return update(phi.data(), phi.size(), y); }
    T predict(std::span<const T> phi) const { return predict(phi.data(), phi.size()); }
#endif

    /// n numbers
    std::vector<T> theta() const {
        std::vector<T> theta(parameters_);
        detail::check(F::theta(estimator_, theta.data(), parameters_));
        return theta;
    }

    /// Goes on from n numbers.
    void set_theta(const std::vector<T> &theta) {
        detail::check(F::set_theta(estimator_, theta.data(), theta.size()));
    }

    /// theta within n bounds on either side; none where there are none
    std::vector<T> bounded(const std::vector<T> &lower, const std::vector<T> &upper) const {
        std::vector<T> theta(parameters_);
        detail::check(F::bounded(estimator_, bounds(lower), bounds(upper), parameters_, theta.data()));
        return theta;
    }

    /// n x n numbers
    std::vector<T> covariance() const {
        std::vector<T> covariance(parameters_ * parameters_);
        detail::check(F::covariance(estimator_, covariance.data(), parameters_));
        return covariance;
    }

    /// of the members of a bank, FG_BANK_MEMBERS numbers
    std::vector<T> weights() const {
        std::vector<T> weights(FG_BANK_MEMBERS);
        detail::check(F::weights(estimator_, weights.data(), weights.size()));
        return weights;
    }

    fg_health_report health() const {
        fg_health_report health;
        detail::check(fg_health(estimator_, &health));
        return health;
    }

    std::vector<unsigned char> to_bytes() const {
        std::size_t length;
        detail::check(fg_save(estimator_, nullptr, 0, &length));
        std::vector<unsigned char> bytes(length);
        detail::check(fg_save(estimator_, bytes.data(), length, &length));
        return bytes;
    }

    std::uint64_t samples() const { return fg_samples(estimator_); }
    std::size_t parameters() const { return parameters_; }
    void reset() { detail::check(fg_reset(estimator_)); }
    /// For the functions of forgetting.h.
    fg_estimator *get() const { return estimator_; }

  private:
    struct Free {
        std::size_t alignment = 1;
        void operator()(unsigned char *memory) const {
            ::operator delete[](memory, std::align_val_t(alignment));
        }
    };

    Estimator() = default;

    const T *bounds(const std::vector<T> &of) const {
        if (!of.empty() && of.size() != parameters_)
            throw Error(FG_ERROR_LENGTH, "bounds are of another number of elements than parameters");
        return of.empty() ? nullptr : of.data();
    }

    Report take(T elapsed, const T *phi, std::size_t n, T y, const T *gamma) {
        Report report;
        detail::check(F::update_after(estimator_, elapsed, phi, n, y, gamma, &report));
        return report;
    }

    void take(const fg_kind *kind) {
        if (!kind) throw Error(FG_ERROR_VALUE, "there is no kind for so many parameters");
        kind_ = kind;
        std::align_val_t alignment{fg_alignment(kind)};
        auto *memory = static_cast<unsigned char *>(::operator new[](fg_size(kind), alignment));
        memory_ = std::unique_ptr<unsigned char[], Free>(memory, Free{fg_alignment(kind)});
    }

    const fg_kind *kind_ = nullptr;
    std::unique_ptr<unsigned char[], Free> memory_;
    fg_estimator *estimator_ = nullptr;
    std::size_t parameters_ = 0;
};

} // namespace fg

#endif
