#include "run/signals.hpp"

#include <csignal>
#include <initializer_list>

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
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}

bool interrupted() { return received != 0; }

}  // namespace bristle
