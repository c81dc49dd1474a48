// The comparison of hard points on all of the host's threads.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace test {

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
