#include "rendering/fabrics/recordings/import_stage.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/place_lock.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/dataset_json.h"

namespace rendering::fabrics {

namespace fs = std::filesystem;
using protocols::FabricId;

namespace {

bool isNewOrEmpty(const fs::path& folder)
{
    std::error_code problem;
    return !fs::exists(folder, problem) || (fs::is_directory(folder, problem) && fs::is_empty(folder, problem));
}

/// The files that an import reads first and writes whole again at its end.
std::string stateOf(const fs::path& folder)
{
    std::string state;
    for (const char* name : {"samples.csv", "dataset.json"})
        if (fs::exists(folder / name)) state += protocols::readWholeFile(folder / name) + '\0';
    return state;
}

Dataset begunAt(const fs::path& folder)
{
    Dataset dataset;
    dataset.name = folder.filename().string();
    dataset.folder = folder;
    return dataset;
}

/// A data set whose dataset.json cannot be read again would be lost with all that it held before.
void requireReadable(const Dataset& dataset, const fs::path& folder)
{
    try {
        datasetFromJson(toJson(dataset), "dataset.json");
    } catch (const protocols::Error& fault) {
        throw protocols::badInput({"the recordings cannot be added (" + std::string(fault.what()) + ")", folder.string(),
                                   "recordings whose description can be read again",
                                   "check the units and names in the recordings; the data set was not changed"});
    }
}

}  // namespace

ImportStage::ImportStage(const fs::path& out)
    : m_out(protocols::folderPath(out)),
      m_isNew(isNewOrEmpty(m_out)),
      m_before(m_isNew ? std::string() : stateOf(m_out)),
      m_dataset(m_isNew ? begunAt(m_out) : readDataset(m_out)),
      m_draft(m_out, protocols::Earlier::FilesJoined)
{
}

FabricId ImportStage::fabricFor(const std::string& name, const std::optional<FabricId>& wanted)
{
    auto& fabrics = m_dataset.fabrics;
    const auto found = std::find_if(fabrics.begin(), fabrics.end(),
                                    [&](const FabricInfo& info) { return wanted ? info.id == *wanted : info.name == name; });
    if (found != fabrics.end()) return found->id;
    if (protocols::firstByteThatIsNotUtf8(name))
        throw protocols::badInput({"the name of the fabric is not UTF-8", name, "a folder or file with a name in UTF-8",
                                   "rename it, such as with convmv, and import it again"});
    if (wanted) protocols::requireGoodNewId(wanted->value, "a fabric", "--fabric");
    FabricId id = wanted.value_or(FabricId());
    for (int number = 1; id.empty(); ++number) {
        const FabricId candidate("F" + std::string(number < 10 ? "0" : "") + std::to_string(number));
        if (std::none_of(fabrics.begin(), fabrics.end(), [&](const FabricInfo& info) { return info.id == candidate; }))
            id = candidate;
    }
    fabrics.push_back({id, name, ""});
    return id;
}

void ImportStage::tellFibre(Fibre fibre)
{
    for (const SamplePlace& place : m_added)
        for (FabricInfo& info : m_dataset.fabrics) {
            if (info.id != place.fabric) continue;
            if (info.fibre && *info.fibre != fibre)
                throw protocols::badInput({"fabric " + info.id.value + " is of " + nameOf(*info.fibre) + ", not " + nameOf(fibre),
                                           (m_out / "dataset.json").string(), "one fibre for each fabric",
                                           "correct --fibre, or the file"});
            info.fibre = fibre;
        }
}

ImportStage::SampleSlot ImportStage::addSample(const FabricId& fabric, Modality modality)
{
    int index = 0;
    const auto there = m_isNew ? std::vector<int>{} : sampleIndices(m_dataset, fabric, modality);
    if (!there.empty()) index = there.back() + 1;
    for (const SamplePlace& place : m_added)
        if (place.fabric == fabric && place.modality == modality) index = std::max(index, place.index + 1);
    m_added.push_back({fabric, modality, index, {}, {}, {}, ownGroup(fabric, modality, index)});
    return {index, m_draft.file(samplePath(m_dataset, fabric, modality, index).lexically_relative(m_dataset.folder))};
}

ImportStage::SampleSlot ImportStage::addPhotograph(const SamplePlace& place)
{
    const SampleSlot slot = addSample(place.fabric, Modality::Visual);
    m_added.back() = place;
    m_added.back().index = slot.index;
    return slot;
}

fs::path ImportStage::surfaceOf(const FabricId& fabric, const SampleSlot& photograph)
{
    return m_draft.file(surfacePath(m_dataset, fabric, photograph.index).lexically_relative(m_dataset.folder));
}

fs::path ImportStage::beside(const SampleSlot& slot, const std::string& ending)
{
    fs::path file = slot.file;
    return file.replace_extension(ending);
}

fs::path ImportStage::addFile(const std::string& name) { return m_draft.file(name); }

void ImportStage::commit()
{
    requireReadable(m_dataset, m_out);
    const protocols::PlaceLock lock(m_out);
    if (stateOf(m_out) != m_before)
        throw protocols::environmentFault({"another program changed the data set during this import", m_out.string(),
                                           "one import into a data set at a time", "import again; nothing was added"});
    std::vector<SamplePlace> places = m_isNew ? std::vector<SamplePlace>{} : readSamplePlaces(m_dataset);
    places.insert(places.end(), m_added.begin(), m_added.end());
    m_dataset.folder = m_draft.path();
    writeSamplePlaces(m_dataset, places);
    writeDatasetJson(m_dataset);
    m_dataset.folder = m_out;
    m_draft.putInPlace({"samples.csv", "dataset.json"});
}

}  // namespace rendering::fabrics
