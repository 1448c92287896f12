// What display_protocol.md demands of a driver, asked of one: for the owner of a display, before a study.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "rendering/display/external_display.h"

namespace rendering {

struct DisplayDemand {
    std::string demand;  ///< "says hello, ..."
    std::string fault;   ///< what it did instead; empty where it meets the demand
};

struct DisplayCheck {
    std::string name;  ///< as its hello told it
    std::vector<DisplayDemand> demands;
    std::vector<double> showMs, clearMs;  ///< from the first byte of a request to its reply, full-size images

    int faults() const;
};

struct DisplayCheckOptions {
    DriverPatience patience;
    std::chrono::milliseconds touchWithin{0};  ///< wait so long for somebody to touch the display; 0: not asked
};

/// Begins the driver, as often as needed, and asks it everything; `tell` hears each demand when it is decided.
DisplayCheck checkDisplay(const DriverAddress& address, const DisplayCheckOptions& options = {},
                          const std::function<void(const DisplayDemand&)>& tell = {});

}  // namespace rendering
