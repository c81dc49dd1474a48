// Ctrl-C: the first one asks the running work to stop, a second one ends the process.
#pragma once

namespace slopemix::cli {

void cancel_on_interrupt();
bool interrupted() noexcept;

// Throws Cancelled once an interrupt has come; for the stretches of work that report no progress.
void stop_if_interrupted();

} // namespace slopemix::cli
