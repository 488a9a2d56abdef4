#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "results/writer.hpp"
#include "run/signals.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <iostream>
#include <new>
#include <pthread.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace {

using namespace bristle;
using namespace bristle::cli;

// Opens /dev/null in place of each standard stream that is closed: the number of the stream would otherwise
// go to the first file that is opened, and messages would go into that file. /dev/null is opened for reading:
// what is written still fails.
void reserve_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", O_RDONLY) < 0) std::abort();
}

// Throws RunError if what was printed did not reach standard output: small outputs are written only here.
void finish_output() {
  std::cout.flush();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) || !std::cout)
    throw RunError(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
}

// The stack that the program needs.
constexpr rlim_t kStackBytes = rlim_t(8) << 20;

// Calls run on a stack of that size, also if `ulimit -s` gives the process, and the threads that it starts,
// less.
int on_large_stack(const std::function<int()>& run) {
  rlimit given{};
  if (getrlimit(RLIMIT_STACK, &given) != 0 || given.rlim_cur >= kStackBytes / 4) return run();
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0 || pthread_attr_setstacksize(&attributes, kStackBytes) != 0 ||
      pthread_setattr_default_np(&attributes) != 0)
    return run();
  int code = kCouldNotFinish;
  std::thread([&] { code = run(); }).join();
  return code;
}

// Runs the command line; returns the exit code, also of errors, which it prints.
int run_program(int argc, char** argv) {
  try {
    const int code = run_command_line(argc, argv);
    finish_output();
    return code;
  } catch (const InputError& e) {
    write_message(fmt::format("bristle: {}\n", e.what()));
    return kBadInput;
  } catch (const Interrupted& e) {
    write_message(fmt::format("bristle: {}\n", e.what()));
    return kInterrupted + run::received_signal();
  } catch (const std::bad_alloc&) {
    write_message("bristle: there is not enough memory (`ulimit -v` may limit it)\n");
    return kCouldNotFinish;
  } catch (const std::filesystem::filesystem_error& e) {
    write_message(fmt::format("bristle: {}: {}\n", e.path1().string(), e.code().message()));
    return kCouldNotFinish;
  } catch (const std::exception& e) {
    write_message(fmt::format("bristle: {}\n", e.what()));
    return kCouldNotFinish;
  }
}

}  // namespace

int main(int argc, char** argv) {
  reserve_standard_streams();
  results::start_hdf5();
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the file-size limit then fails with an error message
  return on_large_stack([&] { return run_program(argc, argv); });
}
