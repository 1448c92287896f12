#include "rendering/fabrics/dataset_hash.h"

#include <algorithm>
#include <map>

#include "protocols/files/number_text.h"
#include "protocols/files/sha256.h"
#include "rendering/fabrics/friction_record.h"

namespace rendering::fabrics {

namespace fs = std::filesystem;

std::string hashOf(const Dataset& dataset, const std::function<std::string(const fs::path&)>& hashOfFile)
{
    std::vector<fs::path> files{"dataset.json"};
    const auto addIfThere = [&](const fs::path& file) {
        if (fs::is_regular_file(dataset.folder / file)) files.push_back(file);
    };
    addIfThere("samples.csv");
    addIfThere("tactile-reference.png");
    if (!dataset.tactileCalibration.empty() && dataset.tactileCalibration != "known") addIfThere(dataset.tactileCalibration);
    std::map<fs::path, double> speeds;  // the rest of an import's report changes no result, and it names folders of one computer
    Dataset inFolder = dataset;         // its paths are relative
    inFolder.folder.clear();
    for (const FabricInfo& fabric : dataset.fabrics)
        for (const Modality modality : {Modality::Visual, Modality::Tactile, Modality::Friction})
            for (const int index : sampleIndices(dataset, fabric.id, modality)) {
                files.push_back(samplePath(inFolder, fabric.id, modality, index));
                if (modality == Modality::Friction)
                    if (const auto speed = ownSpeedMmPerS(dataset.folder / files.back())) speeds[files.back()] = *speed;
                if (modality == Modality::Tactile) addIfThere(knownHeightPath(inFolder, fabric.id, index));
                if (modality == Modality::Visual) addIfThere(surfacePath(inFolder, fabric.id, index));
            }
    std::sort(files.begin(), files.end(),
              [](const fs::path& a, const fs::path& b) { return a.generic_string() < b.generic_string(); });
    std::string list;
    for (const fs::path& file : files) {
        list += file.generic_string() + " " + hashOfFile(dataset.folder / file);
        if (speeds.contains(file)) list += " " + protocols::shortest(speeds[file]) + " mm/s";
        list += "\n";
    }
    return protocols::sha256(list);
}

}  // namespace rendering::fabrics
