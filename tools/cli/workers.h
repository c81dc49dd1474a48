// Work on several threads whose results come together on one.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace slopemix::cli {

// Calls work(0) ... work(count - 1) on up to `threads` threads, and take(result) on this one as results come, in any
// order. After an exception no new work begins; what was begun is finished and taken; then the first exception goes on.
// An exception of take() ends the taking too.
template <class Work, class Take>
void run_on_threads(std::size_t count, std::size_t threads, const Work &work, const Take &take) {
    using Result = decltype(work(count));
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Result> finished;
    std::exception_ptr failure;
    std::size_t next = 0, running = std::min(count, threads);

    const auto work_on = [&] {
        std::unique_lock lock(mutex);
        while (next < count && !failure) {
            const std::size_t k = next++;
            lock.unlock();
            try {
                Result result = work(k);
                lock.lock();
                finished.push_back(std::move(result));
            } catch (...) {
                if (!lock.owns_lock()) lock.lock();
                if (!failure) failure = std::current_exception();
            }
            changed.notify_one();
        }
        --running;
        changed.notify_one();
    };
    {
        std::vector<std::jthread> pool;
        for (std::size_t k = running; k > 0; --k) pool.emplace_back(work_on);

        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return !finished.empty() || running == 0; });
            if (finished.empty()) break;
            Result result = std::move(finished.front());
            finished.pop_front();
            lock.unlock();
            try {
                take(std::move(result));
                lock.lock();
            } catch (...) {
                lock.lock();
                if (!failure) failure = std::current_exception();
                break;
            }
        }
    }
    if (failure) std::rethrow_exception(failure);
}

} // namespace slopemix::cli
