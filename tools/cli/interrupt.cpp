// Ctrl-C and SIGTERM as a flag that the progress callback reads.
#include "interrupt.h"

#include <csignal>

#include "handles.h"

namespace slopemix::cli {

namespace {

volatile std::sig_atomic_t interrupt_came = 0;

extern "C" void note_interrupt(int) { interrupt_came = 1; }

} // namespace

void cancel_on_interrupt() {
    struct sigaction action = {};
    action.sa_handler = note_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() noexcept { return interrupt_came != 0; }

void stop_if_interrupted() {
    if (interrupted()) throw Cancelled();
}

} // namespace slopemix::cli
