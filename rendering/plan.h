// From conditions to the fewest signals that they need; a table, printed by `render --explain`.
#pragma once

#include "protocols/condition.h"

#include <set>
#include <span>
#include <string>
#include <vector>

namespace rendering {

/// Everything that can be computed on the way to a friction image.
enum class Signal {
    Photograph, TactileFrame, FrictionRecord,          // read from the data set
    GreyPhotograph, ShapeFromShading, GreyTactile,     // reliefs
    PhotometricHeight, GeneratedHeight,
    MeasuredTrace, GeneratedSpectrogram, GeneratedTrace,
};

std::string nameOf(Signal signal);

/// The sources of a condition and all they rest on, in an order in which they can be computed.
std::vector<Signal> signalsFor(const protocols::Condition& condition);
std::vector<Signal> signalsFor(std::span<const protocols::ConditionId> conditions);

/// Whether any of them needs the trained generators (and so libtorch).
bool needsGenerators(std::span<const Signal> signals);

/// The table that --explain prints.
std::string explain(std::span<const protocols::ConditionId> conditions);

}  // namespace rendering
