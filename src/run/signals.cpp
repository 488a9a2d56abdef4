#include "run/signals.hpp"

#include <atomic>
#include <csignal>

namespace bristle {
namespace {

// The handler runs on one thread, all ask. A sig_atomic_t is for one thread alone.
std::atomic<bool> received = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// The first asks for an end, the second ends.
void on_signal(int signal) {
  received = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void end_tidily_on_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
}

bool interrupted() { return received; }

}  // namespace bristle
