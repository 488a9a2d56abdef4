#include "run/progress.hpp"

#include "util/text.hpp"

#include <fmt/format.h>
#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace bristle::run {
namespace {

constexpr double kTerminalSeconds = 0.2, kFirstPlainSeconds = 3, kPlainSeconds = 30;

// Returns a number such as "15,300".
std::string count_text(std::size_t count) {
  std::string out = std::to_string(count);
  for (std::size_t i = out.size(); i > 3; i -= 3) out.insert(i - 3, ",");
  return out;
}

}  // namespace

std::string duration_text(double seconds) {
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

Progress::Progress(const std::string& name, std::size_t total, bool quiet)
    : name_(name), total_(total), quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {
  due_ = terminal_ ? kTerminalSeconds : kFirstPlainSeconds;
}

void Progress::step() {
  ++done_;
  show_if_due();
}

void Progress::add_passages(std::size_t count) {
  passages_ += count;
  if (done_ < total_) show_if_due();
}

void Progress::show_if_due() {
  if (quiet_) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  if (seconds < due_ && done_ < total_) return;
  due_ = seconds + (terminal_ ? kTerminalSeconds : kPlainSeconds);
  show(seconds);
}

void Progress::note(const std::string& text) {
  if (!quiet_ && terminal_) write_stderr("\r\033[K");
  write_message(fmt::format("{}: {}\n", name_, text));
}

void Progress::show(double seconds) {
  shown_ = true;
  const double rate = double(done_) / seconds;
  std::string text = fmt::format("{}: computing {}/{} points", name_, done_, total_);
  if (passages_ > 0) text += fmt::format(", {} passages", count_text(passages_));
  if (done_ > 0)
    text += fmt::format(fmt::runtime(rate < 10 ? ", {:.2g} points/s" : ", {:.0f} points/s"), rate);
  if (done_ == total_) text += ", took " + duration_text(seconds);
  else if (done_ > 0) text += fmt::format(", {} left", duration_text(double(total_ - done_) / rate));
  if (!terminal_) {
    write_message(text + "\n");
    return;
  }
  constexpr std::size_t width = 30;
  const std::size_t full = width * done_ / total_;
  write_stderr(
      fmt::format("\r\033[K[{}{}] {}", std::string(full, '#'), std::string(width - full, '.'), text));
}

void Progress::stage(const std::string& text) {
  if (quiet_) return;
  finish();
  bar_ = false;
  if (terminal_) write_message(fmt::format("{}: {}", name_, text));
  else if (shown_) write_message(fmt::format("{}: {}\n", name_, text));
}

void Progress::finish() {
  if (!quiet_ && terminal_) write_stderr(bar_ ? shown_ ? "\n" : "" : "\r\033[K");
}

}  // namespace bristle::run
