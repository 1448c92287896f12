// Progress of a training run: a bar on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <string>

#include "rendering/models/model_card_fields.h"

namespace rendering::models {

struct StepLosses {
    double discriminator = 0;  ///< eq. 1
    double generators = 0;     ///< eq. 2
    double distance = 0;       ///< weighted sum of the distances
    bool finite() const;
};

class ProgressLines {
public:
    ProgressLines(std::ostream& out, bool terminal) : m_out(out), m_terminal(terminal) {}

    void print(const std::string& line);
    void reading(int done, int total);
    /// Smooths the losses. A plain line appears about every ten seconds and at the end.
    void step(int number, double fraction, const StepLosses& losses, double remainingS);
    /// `better`: the distance is smaller than at every earlier validation.
    void validated(int number, const nlohmann::ordered_json& figures, bool better);
    void finished(const ModelCardFields& card);

private:
    void bar(double fraction, const std::string& text);

    std::ostream& m_out;
    bool m_terminal;
    bool m_barShown = false;
    StepLosses m_smooth;
    bool m_started = false;
    std::chrono::steady_clock::time_point m_lastLine{};
};

}  // namespace rendering::models
