#pragma once

namespace bristle {

enum ExitCode {
  kSuccess = 0,
  kCheckFailed = 1,
  kBadInput = 2,
  kCouldNotFinish = 3
};

}  // namespace bristle
