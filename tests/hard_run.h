// How many hard points are compared, and on all of the host's threads.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace test {

// From the environment (docs/stability.md).
struct HardSettings {
    double points = number("SLOPEMIX_HARD_POINTS", 2e5);
    double checked_share = number("SLOPEMIX_HARD_CHECKED", 0.01); // of the points, at 60 digits too
    const char *report = std::getenv("SLOPEMIX_HARD_REPORT");

    void write_report(const std::string &tables) const {
        if (report) std::ofstream(report) << tables;
    }

  private:
    static double number(const char *name, double by_default) {
        const char *text = std::getenv(name);
        return text ? std::atof(text) : by_default;
    }
};

inline std::size_t host_threads() { return std::max(1u, std::thread::hardware_concurrency()); }

// compare(first, step, part) for each part in a thread of its own: points first, first + step, ...
template <class Part, class Compare>
void in_threads(std::vector<Part> &parts, Compare compare) {
    std::vector<std::thread> pool;
    for (std::size_t t = 0; t < parts.size(); ++t)
        pool.emplace_back([&, t] {
            compare(t, parts.size(), parts[t]);
            mpfr_mp_memory_cleanup(); // MPFR keeps constants by thread
        });
    for (std::thread &thread : pool) thread.join();
}

} // namespace test
