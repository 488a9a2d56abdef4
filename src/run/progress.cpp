#include "run/progress.hpp"

#include <fmt/format.h>
#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace bristle::run {
namespace {

constexpr double kTerminalSeconds = 0.2, kPlainSeconds = 30;

}  // namespace

std::string duration_text(double seconds) {
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

Progress::Progress(std::string what, std::size_t total, bool quiet)
    : what_(std::move(what)), total_(total), quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {
  shown_ = start_;
}

void Progress::step() {
  ++done_;
  if (quiet_) return;
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - shown_).count();
  if (since < (terminal_ ? kTerminalSeconds : kPlainSeconds) && done_ < total_) return;
  shown_ = now;
  show(std::chrono::duration<double>(now - start_).count());
}

void Progress::note(const std::string& text) {
  fmt::print(stderr, "{}{}\n", !quiet_ && terminal_ ? "\r\033[K" : "", text);
}

void Progress::show(double seconds) {
  const double rate = double(done_) / seconds;
  const double left = double(total_ - done_) / rate;
  const std::string text =
      fmt::format("{} {}/{} points, {:.2g}/s, {}", what_, done_, total_, rate,
                  done_ < total_ ? duration_text(left) + " left" : "took " + duration_text(seconds));
  if (!terminal_) {
    fmt::print(stderr, "{}\n", text);
    return;
  }
  constexpr std::size_t width = 30;
  const std::size_t full = width * done_ / total_;
  fmt::print(stderr, "\r\033[K[{}{}] {}", std::string(full, '#'), std::string(width - full, '.'), text);
  std::fflush(stderr);
}

void Progress::finish() {
  if (!quiet_ && terminal_) fmt::print(stderr, "\n");
}

}  // namespace bristle::run
