// Reads a record and times a filter on it: best of as many repetitions as fit in the time given.
#pragma once
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

struct Record {
    int n = 0;
    long samples = 0;
    double seconds = 0;
    std::vector<double> numbers;

    Record(int argc, char** argv) {
        if (argc != 5) std::exit(2);
        n = std::atoi(argv[1]);
        samples = std::atol(argv[3]);
        seconds = std::atof(argv[4]);
        numbers.resize(samples * (n + 1));
        FILE* file = std::fopen(argv[2], "rb");
        if (!file || std::fread(numbers.data(), sizeof(double), numbers.size(), file) != numbers.size())
            std::exit(2);
        std::fclose(file);
    }
    const double* phi(long k) const { return &numbers[k * (n + 1)]; }
    double y(long k) const { return numbers[k * (n + 1) + n]; }
};

template <class Filter>
void measure(int n, const Record& record) {
    using Clock = std::chrono::steady_clock;
    Filter filter(n);
    std::vector<double> errors(record.samples);
    double best = 1e300;
    const auto start = Clock::now();
    int repetitions = 0;
    do {
        filter.reset();
        const auto before = Clock::now();
        for (long k = 0; k < record.samples; ++k) errors[k] = filter.update(record.phi(k), record.y(k));
        const double time = std::chrono::duration<double, std::nano>(Clock::now() - before).count();
        if (time < best) best = time;
        ++repetitions;
    } while (repetitions < 5 || std::chrono::duration<double>(Clock::now() - start).count() < record.seconds);
    std::printf("%.6g %.17g\n", best / record.samples, filter.sum());
}
