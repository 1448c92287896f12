// What the operator does with the pieces of fabric between two presentations, as few acts as the two trays need.
#pragma once

#include <QString>
#include <string>
#include <vector>

namespace study::app {

/// One act with one piece. `from` and `to` are letters of slots; "" where the piece comes from or goes to the store of pieces.
struct TrayStep {
    std::string piece;
    QString from, to;
    bool operator==(const TrayStep&) const = default;
};

/// The acts from the pieces that lie on the tray to those that must lie there, each in the order of the slots: first what is
/// taken off, then what changes its slot, then what is put on. `placed`: empty where nothing is known of the tray.
std::vector<TrayStep> trayStepsTo(const std::vector<std::string>& wanted, const std::vector<std::string>& placed);

/// "take off 795 · move 829 from B to A · put 663 on B". Without a step: a sentence that all pieces stay. A tray of one slot
/// needs no letters.
QString trayStepsText(const std::vector<TrayStep>& steps, std::size_t slots);

}  // namespace study::app
