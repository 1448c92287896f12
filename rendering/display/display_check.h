// Check of a driver against the requirements of display_protocol.md, for the owner of a display before a study.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "rendering/display/external_display.h"

namespace rendering {

struct DisplayDemand {
    std::string demand;  ///< requirement in words
    std::string fault;   ///< what the driver did instead; empty where it meets the requirement
};

struct DisplayCheck {
    std::string name;  ///< as stated in its hello
    std::vector<DisplayDemand> demands;
    std::vector<double> showMs, clearMs;  ///< time from the first byte of a request to its reply, full-size images

    int faults() const;
};

struct DisplayCheckOptions {
    DriverPatience patience;
    std::chrono::milliseconds touchWithin{0};  ///< time to wait for a finger on the display; 0 skips this test
};

/// Starts the driver, as often as needed, and tests every requirement; `report` receives each result.
DisplayCheck checkDisplay(const DriverAddress& address, const DisplayCheckOptions& options = {},
                          const std::function<void(const DisplayDemand&)>& report = {});

}  // namespace rendering
