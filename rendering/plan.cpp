#include "rendering/plan.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace rendering {

namespace {

/// One signal: its name and what it is computed from. Below: every signal after those it rests on, so
/// the order of this table is an order of computing.
struct SignalRow {
    Signal signal;
    const char* name;
    std::vector<Signal> from;
    bool byGenerator = false;
};

const std::vector<SignalRow>& signalTable()
{
    static const std::vector<SignalRow> rows{
        {Signal::Photograph, "photograph", {}},
        {Signal::TactileFrame, "tactile frame", {}},
        {Signal::FrictionRecord, "friction record", {}},
        {Signal::GreyPhotograph, "grey photograph", {Signal::Photograph}},
        {Signal::ShapeFromShading, "shape from shading", {Signal::Photograph}},
        {Signal::GreyTactile, "grey tactile frame", {Signal::TactileFrame}},
        {Signal::PhotometricHeight, "photometric height", {Signal::TactileFrame}},
        {Signal::GeneratedHeight, "generated height", {Signal::Photograph}, true},
        {Signal::MeasuredTrace, "measured trace", {Signal::FrictionRecord}},
        {Signal::GeneratedSpectrogram, "generated spectrogram", {Signal::Photograph}, true},
        {Signal::GeneratedTrace, "generated trace", {Signal::GeneratedSpectrogram}},
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

std::vector<Signal> sourcesOf(const protocols::Condition& condition)
{
    std::vector<Signal> sources;
    switch (condition.relief) {
        case protocols::ReliefSource::None:
            break;
        case protocols::ReliefSource::GreyPhotograph:
            sources.push_back(Signal::GreyPhotograph);
            break;
        case protocols::ReliefSource::ShapeFromShading:
            sources.push_back(Signal::ShapeFromShading);
            break;
        case protocols::ReliefSource::GeneratedHeight:
            sources.push_back(Signal::GeneratedHeight);
            break;
        case protocols::ReliefSource::GreyTactile:
            sources.push_back(Signal::GreyTactile);
            break;
        case protocols::ReliefSource::PhotometricHeight:
            sources.push_back(Signal::PhotometricHeight);
            break;
    }
    switch (condition.friction) {
        case protocols::FrictionSource::None:
            break;
        case protocols::FrictionSource::GeneratedTrace:
            sources.push_back(Signal::GeneratedTrace);
            break;
        case protocols::FrictionSource::MeasuredTrace:
            sources.push_back(Signal::MeasuredTrace);
            break;
    }
    return sources;
}

void addWithGround(std::set<Signal>& needed, Signal signal)
{
    needed.insert(signal);
    for (const Signal ground : rowOf(signal).from) addWithGround(needed, ground);
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

std::vector<Signal> signalsFor(const protocols::Condition& condition)
{
    std::set<Signal> needed;
    for (const Signal source : sourcesOf(condition)) addWithGround(needed, source);
    return inOrder(needed);
}

std::vector<Signal> signalsFor(std::span<const protocols::ConditionId> conditions)
{
    std::set<Signal> needed;
    for (const auto& id : conditions)
        for (const Signal signal : signalsFor(protocols::conditionNamed(id.value))) needed.insert(signal);
    return inOrder(needed);
}

bool needsGenerators(std::span<const Signal> signals)
{
    return std::any_of(signals.begin(), signals.end(), [](Signal signal) { return rowOf(signal).byGenerator; });
}

std::string explain(std::span<const protocols::ConditionId> conditions)
{
    std::string text;
    for (const auto& id : conditions) {
        const auto signals = signalsFor(protocols::conditionNamed(id.value));
        text += id.value + std::string(id.value.size() < 9 ? 9 - id.value.size() : 0, ' ') + "  " + joined(signals) +
                (needsGenerators(signals) ? "  [generators, libtorch]" : "  [no libtorch]") + "\n";
    }
    const auto all = signalsFor(conditions);
    text += "computed once a fabric: " + joined(all) + "\n";
    text += needsGenerators(all) ? "libtorch is needed (vis2hap-nn is started)\n" : "libtorch is not needed\n";
    return text;
}

}  // namespace rendering
