#include "sampling/rounded.hpp"

#include "util/text.hpp"

#include <fmt/format.h>

namespace bristle {

double rounded(double value) { return *number_in(fmt::format("{:.7g}", value)); }

}  // namespace bristle
