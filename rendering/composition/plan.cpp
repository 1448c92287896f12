#include "rendering/composition/plan.h"

#include <algorithm>
#include <cassert>
#include <set>

namespace rendering {

namespace {

using protocols::FrictionSource;
using protocols::ReliefSource;

/// Row of a signal: its name, its inputs, and the source of a condition that it is. Every signal comes after its inputs, so
/// the order of the table is a valid order of computation.
struct SignalRow {
    Signal signal;
    const char* name;
    std::vector<Signal> from;
    ReliefSource relief = ReliefSource::None;
    FrictionSource friction = FrictionSource::None;
    bool isGenerated = false;
    bool hasQuality = false;  ///< computed at a choice of prices
};

const std::vector<SignalRow>& signalTable()
{
    static const std::vector<SignalRow> rows{
        {Signal::Photograph, "photograph", {}},
        {Signal::TactileFrame, "tactile frame", {}},
        {Signal::FrictionRecord, "friction record", {}},
        {Signal::GreyPhotograph, "grey photograph", {Signal::Photograph}, ReliefSource::GreyPhotograph},
        {Signal::ShapeFromShading,
         "shape from shading",
         {Signal::Photograph},
         ReliefSource::ShapeFromShading,
         FrictionSource::None,
         false,
         true},
        {Signal::GreyTactile, "grey tactile frame", {Signal::TactileFrame}, ReliefSource::GreyTactile},
        {Signal::PhotometricHeight,
         "photometric height",
         {Signal::TactileFrame},
         ReliefSource::PhotometricHeight,
         FrictionSource::None,
         false,
         true},
        {Signal::HeightGradient, "gradient of the height", {Signal::PhotometricHeight}, ReliefSource::HeightGradient},
        {Signal::GeneratedHeight,
         "generated height",
         {Signal::Photograph},
         ReliefSource::GeneratedHeight,
         FrictionSource::None,
         true,
         true},
        {Signal::MeasuredTrace, "measured trace", {Signal::FrictionRecord}, ReliefSource::None, FrictionSource::MeasuredTrace},
        {Signal::GeneratedSpectrogram,
         "generated spectrogram",
         {Signal::Photograph},
         ReliefSource::None,
         FrictionSource::None,
         true,
         true},
        {Signal::GeneratedTrace,
         "generated trace",
         {Signal::GeneratedSpectrogram},
         ReliefSource::None,
         FrictionSource::GeneratedTrace},
    };
    return rows;
}

const SignalRow& rowOf(Signal signal)
{
    const auto& rows = signalTable();
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.signal == signal; });
    assert(found != rows.end() && "every signal has a row in the table");
    return *found;
}

void addWithInputs(std::set<Signal>& needed, Signal signal)
{
    needed.insert(signal);
    for (const Signal input : rowOf(signal).from) addWithInputs(needed, input);
}

std::vector<Signal> inOrder(const std::set<Signal>& needed)
{
    std::vector<Signal> signals;
    for (const auto& row : signalTable())
        if (needed.contains(row.signal)) signals.push_back(row.signal);
    return signals;
}

std::string joined(std::span<const Signal> signals)
{
    std::string text;
    for (const Signal signal : signals) text += (text.empty() ? "" : ", ") + nameOf(signal);
    return text;
}

}  // namespace

std::string nameOf(Signal signal) { return rowOf(signal).name; }

std::optional<Signal> reliefSignal(const protocols::Condition& condition)
{
    if (condition.relief == ReliefSource::None) return {};
    const auto& rows = signalTable();
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.relief == condition.relief; });
    assert(found != rows.end() && "every source of relief is a signal of the table");
    return found->signal;
}

std::optional<Signal> frictionSignal(const protocols::Condition& condition)
{
    if (condition.friction == FrictionSource::None) return {};
    const auto& rows = signalTable();
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.friction == condition.friction; });
    assert(found != rows.end() && "every source of friction is a signal of the table");
    return found->signal;
}

std::vector<Signal> signalsFor(const protocols::Condition& condition)
{
    std::set<Signal> needed;
    for (const auto& source : {reliefSignal(condition), frictionSignal(condition)})
        if (source) addWithInputs(needed, *source);
    return inOrder(needed);
}

std::vector<Signal> signalsFor(std::span<const protocols::ConditionId> conditions)
{
    std::set<Signal> needed;
    for (const auto& id : conditions)
        for (const Signal signal : signalsFor(protocols::conditionNamed(id.value))) needed.insert(signal);
    return inOrder(needed);
}

bool dependsOnQuality(Signal signal)
{
    const SignalRow& row = rowOf(signal);
    return row.hasQuality || std::any_of(row.from.begin(), row.from.end(), dependsOnQuality);
}

bool isGenerated(Signal signal) { return rowOf(signal).isGenerated; }

Signal recordingOf(Signal signal)
{
    const auto& from = rowOf(signal).from;
    return from.empty() ? signal : recordingOf(from.front());
}

bool needsGenerators(std::span<const Signal> signals)
{
    return std::any_of(signals.begin(), signals.end(), [](Signal signal) { return rowOf(signal).isGenerated; });
}

std::string explain(std::span<const protocols::ConditionId> conditions)
{
    std::string text;
    std::size_t width = 9;
    std::set<protocols::Quality> qualities;
    for (const auto& id : conditions) {
        width = std::max(width, id.value.size());
        if (const auto quality = protocols::qualityOf(id)) qualities.insert(*quality);
    }
    for (const auto& id : conditions) {
        const auto signals = signalsFor(protocols::conditionNamed(id.value));
        text += id.value + std::string(id.value.size() < width ? width - id.value.size() : 0, ' ') + "  " + joined(signals) +
                (needsGenerators(signals) ? "  [generators, libtorch]" : "  [no libtorch]") + "\n";
    }
    const auto all = signalsFor(conditions);
    text += "computed once for each fabric" + std::string(qualities.empty() ? "" : " and quality that needs it") + ": " +
            joined(all) + "\n";
    text += needsGenerators(all) ? "libtorch is needed (vis2hap-nn starts)\n" : "libtorch is not needed\n";
    return text;
}

}  // namespace rendering
