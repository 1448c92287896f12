// How much the analysis of a study computes, and who learns how far it is.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace reports {

/// Quick: everything that the claims need. Whole: besides, the results with one fabric or participant left out, models that only
/// stand beside the claims, and results without excluded participants.
enum class Depth { Quick, Whole };

struct AnalysisOptions {
    Depth depth = Depth::Whole;
    std::size_t resimulated = 0;  ///< studies to simulate for each question, to count false claims; 0: the kept table only
    /// Called before each step with the number of steps done and of all steps; may be empty.
    std::function<void(int done, int total, const std::string& step)> progress = {};
};

}  // namespace reports
