#pragma once

namespace bristle::cli {

enum ExitCode {
  kSuccess = 0,
  kCheckFailed = 1,
  kBadInput = 2,
  kCouldNotFinish = 3,
  kInterrupted = 128  // plus the number of the signal
};

}  // namespace bristle::cli
