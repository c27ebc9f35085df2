// What the machine can do at most: multiply-adds a second, and bytes read and written a second.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace {

#if defined(__AVX512F__)
constexpr int WIDTH = 64;
#elif defined(__AVX__)
constexpr int WIDTH = 32;
#else
constexpr int WIDTH = 16;
#endif

// enough independent chains to hide the latency, few enough for 16 registers
constexpr int CHAINS = 12;
constexpr std::size_t PAGE = 2 << 20;

double now() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since).count();
}

template <typename T> double multiply_adds(long rounds) {
    typedef T Vector __attribute__((vector_size(WIDTH)));
    Vector chain[CHAINS] = {}, half = {}, one = {};
    half += T(0.5);
    one += T(1);
    volatile T different = 0; // or the compiler would see that all chains are the same
    for (Vector& x : chain) x += different;
    const double start = now();
    for (long i = 0; i < rounds; ++i)
        for (Vector& x : chain) x = x * half + one;
    const double seconds = now() - start;
    Vector sum = {};
    for (const Vector& x : chain) sum += x;
    volatile T sink = sum[0];
    (void)sink;
    return rounds * double(CHAINS) * (WIDTH / sizeof(T)) / seconds;
}

__attribute__((noinline)) void scale(double* data, long size, double factor) {
    for (long i = 0; i < size; ++i) data[i] *= factor;
}

// Every thread goes `passes` times over numbers of its own, all at the same time.
struct Team {
    long size, passes;
    int threads;
    std::atomic<int> ready{0};
    std::vector<double> begun, ended;

    void work(int me) {
        const long bytes = size * sizeof(double), whole = (bytes + PAGE - 1) / PAGE * PAGE;
        auto* data = static_cast<double*>(std::aligned_alloc(PAGE, whole));
#ifdef __linux__
        madvise(data, whole, MADV_HUGEPAGE);
#endif
        std::fill(data, data + size, 1.0);
        volatile double factor = 1.0;
        ++ready;
        while (ready < threads) std::this_thread::yield();
        begun[me] = now();
        for (long pass = 0; pass < passes; ++pass) scale(data, size, factor);
        ended[me] = now();
        std::free(data);
    }
};

} // namespace

extern "C" {

// The most that one core did in `trials` trials.
double multiply_add_rate(bool single, int trials) {
    double best = 0;
    for (int i = 0; i < trials; ++i)
        best = std::max(best, single ? multiply_adds<float>(20000) : multiply_adds<double>(20000));
    return best;
}

// Bytes a second, read and written counted each, of x *= a over `bytes` a thread.
double bandwidth(long bytes, long passes, int threads) {
    Team team{long(bytes / sizeof(double)), passes, threads};
    team.begun.resize(threads);
    team.ended.resize(threads);
    std::vector<std::thread> others;
    for (int me = 1; me < threads; ++me) others.emplace_back(&Team::work, &team, me);
    team.work(0);
    for (auto& other : others) other.join();
    const double start = *std::min_element(team.begun.begin(), team.begun.end());
    const double end = *std::max_element(team.ended.begin(), team.ended.end());
    return 2.0 * bytes * passes * threads / (end - start);
}
}
