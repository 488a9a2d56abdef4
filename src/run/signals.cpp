#include "run/signals.hpp"

#include <csignal>

namespace bristle {
namespace {

volatile std::sig_atomic_t received = 0;

// The first asks for an end, the second ends.
void on_signal(int signal) {
  received = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void end_tidily_on_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
}

bool interrupted() { return received != 0; }

}  // namespace bristle
