// The progress bar. Both forms are limited in time, so that short work leaves standard error quiet.
#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include "interrupt.h"
#include "text.h"

namespace slopemix::cli {

namespace {

using namespace std::chrono_literals;

constexpr auto bar_interval = 100ms;
constexpr auto line_interval = 1s;
constexpr int bar_width = 30;
constexpr std::size_t label_width = 38;
constexpr const char *clear_line = "\r\033[K";

} // namespace

Progress::Progress(double total) : terminal_(isatty(STDERR_FILENO) == 1), total_(total) {}

Progress::~Progress() { clear(); }

void Progress::clear() const {
    if (terminal_) std::cerr << clear_line << std::flush;
}

void Progress::start(std::string label, double size) {
    stop_if_interrupted();
    label_ = std::move(label);
    size_ = size;
    if (terminal_) draw_bar(done_ / total_);
}

void Progress::finish() {
    stop_if_interrupted();
    show(1.0);
    done_ += std::exchange(size_, 0.0);
}

void Progress::advance(std::string label, double size) {
    label_ = std::move(label);
    done_ += size;
    show(0.0);
}

void Progress::attach(smx_render_options &options) {
    options.progress = on_progress;
    options.progress_user = this;
}

int Progress::on_progress(void *self, double share) noexcept {
    static_cast<Progress *>(self)->show(share);
    return interrupted() ? 1 : 0;
}

void Progress::show(double share_of_job) {
    if (Clock::now() - last_shown_ < (terminal_ ? Clock::duration(bar_interval) : Clock::duration(line_interval)))
        return;
    const double share = std::clamp((done_ + share_of_job * size_) / total_, 0.0, 1.0);
    if (terminal_)
        draw_bar(share);
    else
        print_line(share);
}

void Progress::draw_bar(double share) {
    const auto filled = static_cast<std::size_t>(share * bar_width);
    std::cerr << clear_line << '[' << std::string(filled, '#') << std::string(bar_width - filled, '.') << "] "
              << fixed(100.0 * share, 0) << " %  " << label_.substr(0, label_width) << std::flush;
    last_shown_ = Clock::now();
}

void Progress::print_line(double share) {
    const int tenths = static_cast<int>(share * 10.0);
    if (tenths <= tenths_printed_) return;
    std::cerr << fixed(100.0 * share, 0) << " %  " << label_ << '\n';
    tenths_printed_ = tenths;
    last_shown_ = Clock::now();
}

} // namespace slopemix::cli
