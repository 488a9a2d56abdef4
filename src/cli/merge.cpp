#include "cli/merge.hpp"

#include "cli/exit_code.hpp"
#include "run/merge.hpp"
#include "run/signals.hpp"

#include <fmt/format.h>

namespace bristle {

int merge_command(const MergeOptions& options) {
  install_signal_handlers();
  PartSet parts(options.parts);
  merge_parts(parts, options.output, options.command_line, interrupted);
  fmt::print("{}: {} points of {} parts, payload sha256 {}\n", options.output, parts.experiment().points(),
             parts.parts().size(), ResultReader(options.output).text("payload_sha256"));
  return kSuccess;
}

}  // namespace bristle
