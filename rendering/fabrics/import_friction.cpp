// Friction records of every instrument: reading is each instrument's; what follows is the same.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>

#include "protocols/errors.h"
#include "rendering/fabrics/csv_table.h"
#include "rendering/fabrics/even_steps.h"
#include "rendering/fabrics/import_kinds.h"
#include "rendering/fabrics/import_sources.h"
#include "rendering/whole_file.h"

namespace rendering::fabrics {

namespace {

constexpr double leastNormalN = 0.05;
constexpr std::size_t mostSamples = 50'000'000;

struct Instrument {
    ImportKind kind;
    std::array<std::string_view, 2> endings;
    FabricNaming naming;
    std::vector<RawRecord> (*read)(const std::filesystem::path&);
};

constexpr Instrument instruments[] = {
    {ImportKind::FrictionCsv, {".csv", ".csv"}, FabricNaming::FolderOrFile, readFrictionCsv},
    {ImportKind::Tribometer, {".txt", ".mtm"}, FabricNaming::FolderOrFile, readTribometer},
    {ImportKind::Labview, {".txt", ".lvm"}, FabricNaming::FolderOrFile, readLabview},
    {ImportKind::Slide, {".csv", ".csv"}, FabricNaming::BeforeForce, readSlide},
};

const Instrument& instrumentOf(ImportKind kind)
{
    return *std::find_if(std::begin(instruments), std::end(instruments), [&](const Instrument& one) { return one.kind == kind; });
}

/// Four significant figures, for people.
std::string inShort(double value)
{
    char buffer[40];
    const auto [end, problem] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 4);
    return std::string(buffer, problem == std::errc{} ? end : buffer);
}

void refuseLostContact(const RawRecord& record)
{
    for (std::size_t row = 0; row < record.normalN.size(); ++row)
        if (record.normalN[row] <= leastNormalN)
            throw protocols::badInput({"the normal force is " + shortest(record.normalN[row]) + " N",
                                       record.where + ", row " + std::to_string(row + 1),
                                       "more than 0.05 N: the probe must be in contact", "cut the record to the stroke"});
}

/// A record at even steps, as it is written.
struct EvenRecord {
    double stepS = 0;
    std::vector<double> values, normalN;
};

EvenRecord evenedOut(const RawRecord& record, const TimeBase& base)
{
    if ((record.timeS.back() - record.timeS.front()) / base.stepS > double(mostSamples))
        throw protocols::badInput({"has a gap in time that is too long to fill", record.where, "time stamps of one stroke", ""});
    if (base.even)
        return {(record.timeS.back() - record.timeS.front()) / double(record.timeS.size() - 1), record.values, record.normalN};
    EvenRecord even{base.stepS, atEvenSteps(record.timeS, record.values, base.stepS), {}};
    if (!record.normalN.empty()) even.normalN = atEvenSteps(record.timeS, record.normalN, base.stepS);
    return even;
}

std::string toCsv(const EvenRecord& even, const std::string& quantity)
{
    const bool forces = !even.normalN.empty();
    std::string text = forces ? "t_s,normal_n,tangential_n\n" : "t_s," + csvCell(quantity) + "\n";
    for (std::size_t i = 0; i < even.values.size(); ++i) {
        text += shortest(std::round(double(i) * even.stepS * 1e9) / 1e9) + ",";
        if (forces) text += shortest(even.normalN[i]) + ",";
        text += shortest(even.values[i]) + "\n";
    }
    return text;
}

double meanOf(const RawRecord& record)
{
    double sum = 0;
    for (std::size_t i = 0; i < record.values.size(); ++i)
        sum += record.normalN.empty() ? record.values[i] : record.values[i] / record.normalN[i];
    return sum / double(record.values.size());
}

std::string describe(const RawRecord& record, const TimeBase& base, const EvenRecord& even)
{
    const bool coefficient = !record.normalN.empty() || record.quantity == "mu";
    std::string line = record.instrument + ", " + std::to_string(record.values.size()) + " rows, " + record.meaning + ", mean " +
                       inShort(meanOf(record)) + (coefficient ? "" : " (not a coefficient)") + ", " + inShort(1 / even.stepS) +
                       " Hz";
    if (!base.even)
        line += " (time stamps uneven, " + inShort(base.smallestS * 1000) + " to " + inShort(base.largestS * 1000) +
                " ms; resampled linearly to the median step, " + std::to_string(even.values.size()) + " samples)";
    return line;
}

/// Whether the data set's friction section may still be set from a record.
bool hasFriction(const Dataset& dataset)
{
    return std::any_of(dataset.fabrics.begin(), dataset.fabrics.end(),
                       [&](const FabricInfo& fabric) { return !sampleIndices(dataset, fabric.id, Modality::Friction).empty(); });
}

void describeRecording(Dataset& dataset, const RawRecord& record, const EvenRecord& even)
{
    dataset.friction.sampleRateHz = std::round(1 / even.stepS * 1e6) / 1e6;
    if (!record.speedMmPerS) return;
    dataset.friction.speedMmPerS = *record.speedMmPerS;
    dataset.friction.lengthMm = std::round(*record.speedMmPerS * even.stepS * double(even.values.size()) * 1e3) / 1e3;
}

std::string remarkOnSpeed(const RawRecord& record, const Dataset& dataset)
{
    const std::string known = inShort(dataset.friction.speedMmPerS) + " mm/s";
    if (!record.speedMmPerS) return ", speed not stated (the data set's " + known + " is assumed)";
    const std::string own = inShort(*record.speedMmPerS) + " mm/s";
    if (std::abs(*record.speedMmPerS / dataset.friction.speedMmPerS - 1) < 0.01) return ", " + own;
    return ", " + own + " (the data set states " + known + ")";
}

}  // namespace

Lines importFrictionFiles(const ImportRequest& request, ImportStage& stage)
{
    const Instrument& instrument = instrumentOf(request.kind);
    const auto files = sourceFiles(request.from, instrument.endings, instrument.naming);
    Dataset& dataset = stage.dataset();
    bool first = stage.isNew() || !hasFriction(dataset);
    Lines lines;
    for (const SourceFile& source : files)
        for (const RawRecord& record : instrument.read(source.file)) {
            const TimeBase base = timeBaseOf(record.timeS, record.where);
            refuseLostContact(record);
            const EvenRecord even = evenedOut(record, base);
            if (first) describeRecording(dataset, record, even);
            first = false;
            const auto fabric = stage.fabricFor(source.fabricName, request.fabric);
            const auto slot = stage.addSample(fabric, Modality::Friction);
            writeWholeFile(slot.file, toCsv(even, record.quantity));
            const FabricInfo& info = dataset.fabric(fabric);
            lines.push_back(fabric.value + (info.name == fabric.value ? "" : " " + info.name) + ", sample " +
                            std::to_string(slot.index) + ": " + describe(record, base, even) + remarkOnSpeed(record, dataset));
        }
    return lines;
}

}  // namespace rendering::fabrics
