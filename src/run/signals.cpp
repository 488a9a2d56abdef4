#include "run/signals.hpp"

#include <atomic>
#include <csignal>

namespace bristle::run {
namespace {

// Atomic because the handler runs on one thread and all
// threads read; sig_atomic_t is safe within one thread only.
std::atomic<bool> received = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// The first signal requests an end, the second terminates the process.
void on_signal(int signal) {
  received = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void install_signal_handlers() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // set by nohup
}

bool interrupted() { return received; }

}  // namespace bristle::run
