#include "util/process.hpp"

#include "util/error.hpp"
#include "util/file.hpp"
#include "bristle/sanitizer.hpp"

#include <fmt/format.h>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bristle {

std::string host_name() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

namespace {

constexpr std::size_t kMaxText = std::size_t(64) << 20;  // bytes

void limit(int resource, rlim_t soft, rlim_t hard) {
  const rlimit limits{soft, hard};
  setrlimit(resource, &limits);
}

// Returns the address space of this process in bytes.
rlim_t memory_in_use() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * rlim_t(sysconf(_SC_PAGESIZE));
}

// Writes as much of the text as the pipe takes: the reader judges what arrives.
void write_all(int descriptor, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = write(descriptor, text.data() + at, text.size() - at);
    if (n < 0 && errno != EINTR) return;
    if (n > 0) at += std::size_t(n);
  }
}

// Silences inherited signal handlers and the C library's messages, which would report a crash a second time:
// the parent process reports it.
void silence_crash_output() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(signal, SIG_DFL);
  const int null_device = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (null_device < 0) return;
  dup2(null_device, STDERR_FILENO);
  close(null_device);
}

[[noreturn]] void run_child(int descriptor, const std::function<std::string()>& work, const Limits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  silence_crash_output();
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_CPU, rlim_t(limits.seconds), rlim_t(limits.seconds) + 1);
  const rlim_t memory = memory_in_use() + limits.memory;
  if (!kSanitized) limit(RLIMIT_AS, memory, memory);
  std::string answer;
  try {
    answer = "+" + work();
  } catch (const SystemError& e) {
    answer = std::string("!") + e.what();
  } catch (const std::exception& e) {
    answer = std::string("-") + e.what();
  }
  write_all(descriptor, answer);
  _exit(0);
}

std::string read_all(int descriptor) {
  std::string text;
  char buffer[65536];
  while (text.size() < kMaxText) {
    const ssize_t n = read(descriptor, buffer, sizeof buffer);
    if (n == 0 || (n < 0 && errno != EINTR)) break;
    if (n > 0) text.append(buffer, std::size_t(n));
  }
  return text;
}

}  // namespace

ProcessResult run_process(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw SystemError(fmt::format("cannot start: {}: {}", command, system_reason(errno)));
  ProcessResult out{0, ""};
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) out.output.append(buffer, n);
  out.code = pclose(pipe);
  return out;
}

std::string run_isolated(const std::function<std::string()>& work, const Limits& limits) {
  int ends[2];
  std::fflush(nullptr);  // otherwise the child prints the buffered output a second time
  if (pipe(ends) != 0) throw SystemError(fmt::format("cannot open a pipe: {}", system_reason(errno)));
  const pid_t child = fork();
  if (child < 0) {
    const int reason = errno;
    for (const int end : ends) close(end);
    throw SystemError(fmt::format("cannot start a process: {}", system_reason(reason)));
  }
  if (child == 0) {
    close(ends[0]);
    run_child(ends[1], work, limits);
  }
  close(ends[1]);
  const std::string answer = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    throw MalformedError(fmt::format("malformed: reading it takes more than {} s", limits.seconds));
  if (WIFSIGNALED(status))
    throw MalformedError(fmt::format("malformed: the process that read it was ended by signal {} ({})",
                                     WTERMSIG(status), strsignal(WTERMSIG(status))));
  if (answer.empty() || WEXITSTATUS(status) != 0)
    throw MalformedError("malformed: the process that read it ended without a result");
  if (answer[0] == '!') throw SystemError(answer.substr(1));
  if (answer[0] == '-') throw MalformedError(answer.substr(1));
  return answer.substr(1);
}

}  // namespace bristle
