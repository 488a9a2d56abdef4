#include "cli/merge.hpp"

#include "cli/exit_code.hpp"
#include "run/merge.hpp"
#include "run/signals.hpp"

#include <fmt/format.h>

namespace bristle::cli {

int merge_command(const MergeOptions& options) {
  run::install_signal_handlers();
  require_replaceable(options.output, results::replaceable_by({}));
  run::PartSet parts(options.parts);
  run::merge_parts(parts, options.output, options.command_line, run::interrupted);
  fmt::print("{}: {} points of {} parts, payload sha256 {}\n", options.output, parts.experiment().points(),
             parts.parts().size(), results::ResultReader(options.output).text("payload_sha256"));
  return kSuccess;
}

}  // namespace bristle::cli
