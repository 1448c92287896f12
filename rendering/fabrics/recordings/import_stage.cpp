#include "rendering/fabrics/recordings/import_stage.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "rendering/fabrics/dataset_json.h"

namespace rendering::fabrics {

namespace fs = std::filesystem;
using protocols::FabricId;

namespace {

protocols::Error cannotWrite(const fs::path& out, const fs::filesystem_error& error)
{
    return protocols::environmentFault({"cannot be written (" + error.code().message() + ")", out.string(),
                                        "a writable folder with free space", "free space or choose another folder"});
}

void makeFolder(const fs::path& folder, const fs::path& out)
{
    try {
        fs::create_directories(folder);
    } catch (const fs::filesystem_error& error) {
        throw cannotWrite(out, error);
    }
}

}  // namespace

ImportStage::ImportStage(const fs::path& out) : m_out(fs::absolute(out).lexically_normal())
{
    if (!m_out.has_filename()) m_out = m_out.parent_path();
    std::error_code problem;
    const bool there = fs::exists(m_out, problem);
    m_isNew = !there || (fs::is_directory(m_out, problem) && fs::is_empty(m_out, problem));
    if (m_isNew) {
        m_dataset.name = m_out.filename().string();
        m_dataset.folder = m_out;
    } else {
        m_dataset = readDataset(m_out);
    }
    m_staging = there ? m_out / ".import.unfinished" : m_out.parent_path() / ("." + m_out.filename().string() + ".unfinished");
    fs::remove_all(m_staging, problem);
}

ImportStage::~ImportStage()
{
    std::error_code ignored;
    fs::remove_all(m_staging, ignored);
}

FabricId ImportStage::fabricFor(const std::string& name, const std::optional<FabricId>& wanted)
{
    auto& fabrics = m_dataset.fabrics;
    const auto found = std::find_if(fabrics.begin(), fabrics.end(),
                                    [&](const FabricInfo& info) { return wanted ? info.id == *wanted : info.name == name; });
    if (found != fabrics.end()) return found->id;
    if (wanted && !isFolderName(wanted->value))
        throw protocols::badInput({"\"" + wanted->value + "\" cannot be the id of a fabric", "--fabric",
                                   "letters, digits, - and _", "choose another id"});
    FabricId id = wanted.value_or(FabricId());
    for (int number = 1; id.empty(); ++number) {
        const FabricId candidate("F" + std::string(number < 10 ? "0" : "") + std::to_string(number));
        if (std::none_of(fabrics.begin(), fabrics.end(), [&](const FabricInfo& info) { return info.id == candidate; }))
            id = candidate;
    }
    fabrics.push_back({id, name, ""});
    return id;
}

ImportStage::SampleSlot ImportStage::addSample(const FabricId& fabric, Modality modality)
{
    int index = 0;
    const auto there = m_isNew ? std::vector<int>{} : sampleIndices(m_dataset, fabric, modality);
    if (!there.empty()) index = there.back() + 1;
    for (const SamplePlace& place : m_added)
        if (place.fabric == fabric && place.modality == modality) index = std::max(index, place.index + 1);
    m_added.push_back({fabric, modality, index, {}, {}, {}, ownGroup(fabric, modality, index)});
    const fs::path relative = fs::relative(samplePath(m_dataset, fabric, modality, index), m_dataset.folder);
    m_files.push_back(relative);
    makeFolder((m_staging / relative).parent_path(), m_out);
    return {index, m_staging / relative};
}

fs::path ImportStage::beside(const SampleSlot& slot, const std::string& ending)
{
    fs::path file = slot.file;
    file.replace_extension(ending);
    m_files.push_back(file.lexically_relative(m_staging));
    return file;
}

fs::path ImportStage::addFile(const std::string& name)
{
    makeFolder(m_staging, m_out);
    m_files.emplace_back(name);
    return m_staging / name;
}

void ImportStage::commit()
{
    std::vector<SamplePlace> places = m_isNew ? std::vector<SamplePlace>{} : readSamplePlaces(m_dataset);
    places.insert(places.end(), m_added.begin(), m_added.end());
    makeFolder(m_staging, m_out);
    // Write everything that needs space before anything moves; renaming needs none.
    m_dataset.folder = m_staging;
    writeSamplePlaces(m_dataset, places);
    writeDatasetJson(m_dataset);
    m_dataset.folder = m_out;
    std::vector<fs::path> moved;
    try {
        if (!fs::exists(m_out)) {
            fs::rename(m_staging, m_out);
            return;
        }
        for (const fs::path& file : m_files) {
            fs::create_directories((m_out / file).parent_path());
            fs::rename(m_staging / file, m_out / file);
            moved.push_back(file);
        }
        fs::rename(m_staging / "samples.csv", m_out / "samples.csv");
        fs::rename(m_staging / "dataset.json", m_out / "dataset.json");
    } catch (const fs::filesystem_error& error) {
        std::error_code ignored;
        for (const fs::path& file : moved) fs::remove(m_out / file, ignored);
        throw cannotWrite(m_out, error);
    }
}

}  // namespace rendering::fabrics
