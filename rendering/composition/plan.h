// The smallest set of signals that conditions need, from a table that `render --explain` prints.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocols/condition.h"

namespace rendering {

/// Every signal on the way to a friction image.
enum class Signal {
    Photograph,
    TactileFrame,
    FrictionRecord,  // Recordings, read from the data set.
    GreyPhotograph,
    ShapeFromShading,
    GreyTactile,  // Reliefs.
    PhotometricHeight,
    HeightGradient,
    GeneratedHeight,
    MeasuredTrace,
    GeneratedSpectrogram,
    GeneratedTrace,
};

std::string nameOf(Signal signal);

/// Signal of a condition's relief or friction; nullopt where the condition has no such part.
std::optional<Signal> reliefSignal(const protocols::Condition& condition);
std::optional<Signal> frictionSignal(const protocols::Condition& condition);

/// Signals of a condition and their inputs, in a valid order of computation.
std::vector<Signal> signalsFor(const protocols::Condition& condition);
std::vector<Signal> signalsFor(std::span<const protocols::ConditionId> conditions);

/// True where a quality changes how the signal or one of its inputs is computed.
bool dependsOnQuality(Signal signal);
/// True for a signal that a trained generator makes.
bool isGenerated(Signal signal);
/// Recording from which a signal is computed: photograph, tactile frame or friction record.
Signal recordingOf(Signal signal);

/// True where a signal needs the trained generators and therefore libtorch.
bool needsGenerators(std::span<const Signal> signals);

/// Table that --explain prints.
std::string explain(std::span<const protocols::ConditionId> conditions);

}  // namespace rendering
