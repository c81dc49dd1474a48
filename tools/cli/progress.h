// How far the work is, on standard error: a bar on a terminal, a sparse line elsewhere.
#pragma once

#include <chrono>
#include <string>

#include "slopemix.h"

namespace slopemix::cli {

// Work comes in jobs; each has a label and a size in any unit, and `total` is the sum of the sizes.
class Progress {
  public:
    explicit Progress(double total);
    ~Progress();
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    void start(std::string label, double size);
    void finish();                                // the current job is done
    void advance(std::string label, double size); // a job was done elsewhere; goes on after an interrupt
    void clear() const;                           // takes the bar away, so that other text can be printed

    // Asks a rendering call to report its share of the current job here, and to stop on an interrupt.
    void attach(smx_render_options &options);

  private:
    using Clock = std::chrono::steady_clock;

    static int on_progress(void *self, double share) noexcept;
    void show(double share_of_job);
    void draw_bar(double share);
    void print_line(double share);

    const bool terminal_;
    const double total_;
    double done_ = 0.0;
    double size_ = 0.0;
    std::string label_;
    int tenths_printed_ = 0;
    Clock::time_point last_shown_ = Clock::now();
};

} // namespace slopemix::cli
