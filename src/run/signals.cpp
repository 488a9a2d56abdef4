#include "run/signals.hpp"

#include <atomic>
#include <csignal>
#include <ctime>

namespace bristle::run {
namespace {

// Number of the received signal; 0: none. Atomic because the handler runs on one thread and all threads read;
// sig_atomic_t is safe within one thread only.
std::atomic<int> received = 0;
static_assert(std::atomic<int>::is_always_lock_free);

// `timeout` sends its signal to the program and then to all processes of its group, so that the program
// receives it twice. Signals within this time of the first one are the same request.
constexpr double kSameRequest = 0.5;  // s

std::atomic<double> first_request = 0;  // s
static_assert(std::atomic<double>::is_always_lock_free);

double seconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Handles a signal: the first request asks for an end, the second one terminates the process.
void on_signal(int signal) {
  if (received == 0) {
    first_request = seconds();
    received = signal;
  } else if (seconds() - first_request > kSameRequest) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
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
