#include "tile_queue.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "error.h"

namespace smx {

namespace {

constexpr std::uint64_t most_items = 1u << 18, least_items = 1u << 12;
constexpr std::uint64_t tiles_per_device = 4;

// What a tile's work throws to itself when the job has ended without it.
struct Stopped {};

class TileQueue {
  public:
    explicit TileQueue(const TileJob &job) : job_(job), finished_(job.tiles.size(), false) {
        for (const Tile &tile : job.tiles) all_rows_ += tile.rows;
    }
    double run(Context &context);

  private:
    void work_on(Context &device);
    bool next_tile(std::size_t &index);
    Step step_of(const Tile &tile);
    void finish(std::size_t index);
    void fail_with(const std::exception_ptr &failure);
    void oversee();
    void tell(std::unique_lock<std::mutex> &lock);
    bool can_take() const { return taken_ < finished_.size() && finished_[taken_]; }

    const TileJob &job_;
    std::mutex mutex_;
    std::condition_variable news_, room_; // for the caller's thread, for the devices'
    std::vector<bool> finished_;
    std::size_t next_ = 0, taken_ = 0, running_ = 0;
    double all_rows_ = 0.0, rows_done_ = 0.0, rows_told_ = 0.0;
    double busiest_ = 0.0;
    std::exception_ptr failure_;
};

bool TileQueue::next_tile(std::size_t &index) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return failure_ || next_ == job_.tiles.size() || next_ < taken_ + job_.ahead; });
    if (failure_ || next_ == job_.tiles.size()) return false;
    index = next_++;
    return true;
}

Step TileQueue::step_of(const Tile &tile) {
    return [this, &tile, before = 0.0](double share) mutable {
        const std::lock_guard lock(mutex_);
        if (failure_) throw Stopped();
        rows_done_ += (share - before) * tile.rows;
        before = share;
        news_.notify_one();
    };
}

void TileQueue::finish(std::size_t index) {
    const std::lock_guard lock(mutex_);
    finished_[index] = true;
    news_.notify_one();
}

void TileQueue::fail_with(const std::exception_ptr &failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = failure;
    room_.notify_all();
}

void TileQueue::work_on(Context &device) {
    double seconds = 0.0;
    try {
        const TileWork work = job_.start(device);
        for (std::size_t index = 0; next_tile(index); finish(index)) {
            const Step step = step_of(job_.tiles[index]);
            seconds += work(job_.tiles[index], step);
            step(1.0);
        }
    } catch (const Stopped &) { // the failure is known
    } catch (...) {
        fail_with(std::current_exception());
    }
    const std::lock_guard lock(mutex_);
    busiest_ = std::max(busiest_, seconds);
    --running_;
    news_.notify_one();
}

// Tells the caller how much is done.
void TileQueue::tell(std::unique_lock<std::mutex> &lock) {
    rows_told_ = rows_done_;
    lock.unlock();
    if (job_.progress && job_.progress(std::min(rows_told_ / all_rows_, 1.0)))
        fail(Fault::Cancelled, "cancelled by the progress callback");
    lock.lock();
}

// The caller's thread: takes finished tiles and tells of progress until nothing is left to do or something failed.
void TileQueue::oversee() {
    std::unique_lock lock(mutex_);
    for (;;) {
        news_.wait(lock, [&] { return failure_ || can_take() || rows_done_ > rows_told_ || running_ == 0; });
        if (failure_) return;
        if (can_take()) {
            const Tile &tile = job_.tiles[taken_];
            lock.unlock();
            job_.take(tile);
            lock.lock();
            ++taken_;
            room_.notify_all();
        } else if (rows_done_ > rows_told_) {
            tell(lock);
        } else {
            return;
        }
    }
}

double TileQueue::run(Context &context) {
    const std::vector<Context *> devices = context.devices();
    {
        std::vector<std::jthread> threads;
        running_ = std::min(devices.size(), job_.tiles.size());
        try {
            for (std::size_t k = 0, count = running_; k < count; ++k)
                threads.emplace_back([this, device = devices[k]] { work_on(*device); });
            oversee();
        } catch (...) {
            fail_with(std::current_exception());
        }
    }
    if (failure_) std::rethrow_exception(failure_);
    return busiest_;
}

} // namespace

std::vector<Tile> tiles_of(std::uint32_t rows, std::uint32_t row_items, std::size_t devices, const Tiling &tiling) {
    std::uint64_t items = most_items;
    if (devices > 1) {
        const std::uint64_t share = std::uint64_t{rows} * row_items / (tiles_per_device * devices);
        items = std::clamp(share, least_items, most_items);
    }
    const auto wanted = static_cast<std::uint32_t>(items / row_items);
    const std::uint32_t tile_rows = std::clamp(tiling.rows ? tiling.rows : wanted, 1u, rows);
    std::vector<Tile> tiles;
    for (std::uint32_t row = 0; row < rows; row += tile_rows) tiles.push_back({row, std::min(tile_rows, rows - row)});
    return tiles;
}

std::uint32_t most_rows(const std::vector<Tile> &tiles) { return tiles.front().rows; }

double run_tiles(Context &context, const TileJob &job) { return TileQueue(job).run(context); }

} // namespace smx
