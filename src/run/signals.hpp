#pragma once

namespace bristle::run {

// Installs handlers for SIGINT, SIGTERM and SIGHUP. The first signal makes interrupted() return true; a
// signal that follows more than half a second later terminates the process.
void install_signal_handlers();
bool interrupted();
int received_signal();  // number of the signal; 0: none

}  // namespace bristle::run
