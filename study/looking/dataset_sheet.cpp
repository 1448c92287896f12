#include "study/looking/dataset_sheet.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "rendering/composition/fabric_signals.h"
#include "study/looking/open_study.h"
#include "study/looking/read_signal.h"

namespace study::looking {

namespace {

namespace fs = std::filesystem;
using rendering::fabrics::Dataset;
using rendering::fabrics::Modality;

std::string pitchText(const char* what, const std::optional<double>& mmPerPixel)
{
    return std::string(what) + (mmPerPixel ? " " + roughFigure(*mmPerPixel) + " mm per pixel" : " of unknown scale");
}

std::string aboutOf(const Dataset& dataset)
{
    const std::string origin = dataset.procedural ? "procedural, " : "";
    const std::string pairing =
        dataset.pairing == rendering::fabrics::Pairing::Aligned ? "signals of the same places" : "signals of different places";
    const std::string strokes = "strokes at " + roughFigure(dataset.friction.speedMmPerS) + " mm/s and " +
                                roughFigure(dataset.friction.sampleRateHz) + " Hz";
    const std::string licence = dataset.licence.empty() ? "" : "; " + dataset.licence;
    return origin + pairing + "; " + pitchText("photographs", dataset.cameraMmPerPixel) + "; " +
           pitchText("frames", dataset.tactileMmPerPixel) + "; " + strokes + licence;
}

int countOf(const Dataset& dataset, const protocols::FabricId& fabric, Modality modality)
{
    return static_cast<int>(sampleIndices(dataset, fabric, modality).size());
}

int knownHeightsOf(const Dataset& dataset, const protocols::FabricId& fabric)
{
    const auto indices = sampleIndices(dataset, fabric, Modality::Tactile);
    return static_cast<int>(std::count_if(indices.begin(), indices.end(),
                                          [&](int index) { return fs::exists(knownHeightPath(dataset, fabric, index)); }));
}

/// File index of sample number `place` (from 0); none if there are fewer samples.
std::optional<int> indexAt(const Dataset& dataset, const protocols::FabricId& fabric, Modality modality, int place)
{
    const auto indices = sampleIndices(dataset, fabric, modality);
    if (place < 0 || place >= static_cast<int>(indices.size())) return std::nullopt;
    return indices[static_cast<std::size_t>(place)];
}

SeenSignal computedHeight(const Dataset& dataset, const protocols::FabricId& fabric, int index)
{
    requireNotOfOpenStudy(samplePath(dataset, fabric, Modality::Tactile, index));
    rendering::RenderedFabrics counts;
    rendering::SignalComputation computation(dataset, rendering::models::Quality::Accurate);
    const auto signals = computation.measured(fabric, {0, index, 0},
                                              {rendering::Signal::TactileFrame, rendering::Signal::PhotometricHeight}, counts);
    return seenHeight(
        signals.images.at(rendering::Signal::PhotometricHeight), dataset.tactileMmPerPixel,
        fabric.value + " height of tactile " + samplePath(dataset, fabric, Modality::Tactile, index).filename().string(),
        "computed from the frame");
}

class SheetBuilder {
public:
    /// Adds a signal, or the reason why it cannot be read.
    template <class Read>
    void add(Read read)
    {
        try {
            m_sheet.signals.push_back(read());
        } catch (const protocols::Error& fault) {
            m_sheet.faults.emplace_back(fault.what());
        }
    }
    FabricSheet finished() { return std::move(m_sheet); }

private:
    FabricSheet m_sheet;
};

}  // namespace

int FabricCounts::most() const { return std::max({photographs, frames, strokes}); }

DatasetOverview overviewOf(const fs::path& folder)
{
    requireNotOfOpenStudy(folder);
    const Dataset dataset = rendering::fabrics::readDataset(folder);
    DatasetOverview seen{dataset.name, aboutOf(dataset), {}};
    for (const auto& fabric : dataset.fabrics)
        seen.fabrics.push_back({fabric.id.value, fabric.name, fabric.structure, countOf(dataset, fabric.id, Modality::Visual),
                                countOf(dataset, fabric.id, Modality::Tactile), knownHeightsOf(dataset, fabric.id),
                                countOf(dataset, fabric.id, Modality::Friction)});
    return seen;
}

FabricSheet sheetOf(const fs::path& folder, const std::string& fabricId, int sample)
{
    requireNotOfOpenStudy(folder);
    const Dataset dataset = rendering::fabrics::readDataset(folder);
    const protocols::FabricId fabric = dataset.fabric(protocols::FabricId(fabricId)).id;
    SheetBuilder sheet;
    const auto addFile = [&](Modality modality) {
        if (const auto index = indexAt(dataset, fabric, modality, sample))
            sheet.add([&] { return readSignal(samplePath(dataset, fabric, modality, *index)); });
    };
    addFile(Modality::Visual);
    if (const auto photograph = indexAt(dataset, fabric, Modality::Visual, sample))
        if (const fs::path surface = surfacePath(dataset, fabric, *photograph); fs::exists(surface))
            sheet.add([&] { return readSignal(surface); });
    addFile(Modality::Tactile);
    if (const auto press = indexAt(dataset, fabric, Modality::Tactile, sample)) {
        const fs::path known = knownHeightPath(dataset, fabric, *press);
        if (fs::exists(known))
            sheet.add([&] { return readSignal(known); });
        else if (!dataset.tactileCalibration.empty() && dataset.tactileCalibration != "known")
            sheet.add([&] { return computedHeight(dataset, fabric, *press); });
    }
    addFile(Modality::Friction);
    return sheet.finished();
}

}  // namespace study::looking
