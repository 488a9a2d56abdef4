#include "run/signals.hpp"

#include <atomic>
#include <csignal>

namespace bristle::run {
namespace {

// The number of the signal; 0: none. Atomic because the handler runs on one thread and all threads read;
// sig_atomic_t is safe within one thread only.
std::atomic<int> received = 0;
static_assert(std::atomic<int>::is_always_lock_free);

// The first signal requests an end, the second terminates the process.
void on_signal(int signal) {
  received = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void install_signal_handlers() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // set by nohup
}

bool interrupted() { return received != 0; }
int received_signal() { return received; }

}  // namespace bristle::run
