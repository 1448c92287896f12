// A display's driver that fetches its images from the server (`vis2hap display serve`). It runs under an account of its own, so
// that nobody at the station can read the images: the station sends tickets, and the relay sends their images to the device.
#pragma once

#include <string>

namespace study::commands {

/// Serves one station after the other at 127.0.0.1:`port` (0: the system chooses; the port is printed), and does not return
/// while it can serve. A connection without a request for 3 s ends. One that was idle for 10 s while nothing can be felt ends
/// when another one waits. `specification`: exec:COMMAND or tcp:HOST:PORT. Throws badInput for another display, for a port that
/// is in use, and for a login without the role display.
int serveDisplay(const std::string& address, const std::string& specification, int port);

}  // namespace study::commands
