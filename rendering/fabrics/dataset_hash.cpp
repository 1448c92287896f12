#include "rendering/fabrics/dataset_hash.h"

#include <algorithm>

#include "protocols/files/sha256.h"

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
    Dataset inFolder = dataset;  // its paths are relative
    inFolder.folder.clear();
    for (const FabricInfo& fabric : dataset.fabrics)
        for (const Modality modality : {Modality::Visual, Modality::Tactile, Modality::Friction})
            for (const int index : sampleIndices(dataset, fabric.id, modality)) {
                files.push_back(samplePath(inFolder, fabric.id, modality, index));
                if (modality == Modality::Tactile) addIfThere(knownHeightPath(inFolder, fabric.id, index));
                if (modality == Modality::Visual) addIfThere(surfacePath(inFolder, fabric.id, index));
            }
    std::sort(files.begin(), files.end(),
              [](const fs::path& a, const fs::path& b) { return a.generic_string() < b.generic_string(); });
    std::string list;
    for (const fs::path& file : files) list += file.generic_string() + " " + hashOfFile(dataset.folder / file) + "\n";
    return protocols::sha256(list);
}

}  // namespace rendering::fabrics
