// From conditions to the fewest signals that they need; a table, printed by `render --explain`.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "protocols/condition.h"

namespace rendering {

/// Everything that can be computed on the way to a friction image.
enum class Signal {
    Photograph,
    TactileFrame,
    FrictionRecord,  // read from the data set
    GreyPhotograph,
    ShapeFromShading,
    GreyTactile,  // reliefs
    PhotometricHeight,
    HeightGradient,
    GeneratedHeight,
    MeasuredTrace,
    GeneratedSpectrogram,
    GeneratedTrace,
};

std::string nameOf(Signal signal);

/// The signal that a condition takes its relief from, or its friction; none where it has no such part.
std::optional<Signal> reliefSignal(const protocols::Condition& condition);
std::optional<Signal> frictionSignal(const protocols::Condition& condition);

/// The sources of a condition and all they rest on, in an order in which they can be computed.
std::vector<Signal> signalsFor(const protocols::Condition& condition);
std::vector<Signal> signalsFor(std::span<const protocols::ConditionId> conditions);

/// Whether a trained generator makes the signal.
bool byGenerator(Signal signal);
/// The recording that lies below a signal: photograph, tactile frame or friction record.
Signal recordingBelow(Signal signal);

/// Whether any of them needs the trained generators (and so libtorch).
bool needsGenerators(std::span<const Signal> signals);

/// The table that --explain prints.
std::string explain(std::span<const protocols::ConditionId> conditions);

}  // namespace rendering
