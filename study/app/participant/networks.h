// The networks of this computer, so that the operator can choose where the participant's page is reachable.
#pragma once

#include <QString>
#include <vector>

namespace study::app {

struct Network {
    QString name;     ///< of the interface: "wlan0"
    QString address;  ///< of this computer in it
};

/// Interfaces that are up, without loopback and without addresses that need a zone. Empty where the system names none.
std::vector<Network> networksOfThisComputer();

}  // namespace study::app
