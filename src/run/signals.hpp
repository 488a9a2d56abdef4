#pragma once

namespace bristle {

// From now on SIGINT, SIGTERM and SIGHUP only ask for an end, of which interrupted() tells; a second one
// ends.
void end_tidily_on_signals();
bool interrupted();

}  // namespace bristle
