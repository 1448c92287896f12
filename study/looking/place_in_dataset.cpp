#include "study/looking/place_in_dataset.h"

namespace study::looking {

namespace fs = std::filesystem;

std::optional<PlaceInDataset> placeInDataset(const fs::path& file)
{
    std::error_code problem;
    const fs::path whole = fs::weakly_canonical(file, problem);
    const fs::path signal = whole.parent_path(), fabric = signal.parent_path();
    if (!fs::exists(fabric.parent_path() / "dataset.json", problem)) return std::nullopt;
    return PlaceInDataset{rendering::fabrics::readDataset(fabric.parent_path()), fabric.filename().string(),
                          signal.filename().string()};
}

std::string titleOf(const fs::path& file, const std::optional<PlaceInDataset>& place)
{
    return place ? place->fabric + " " + place->signal + " " + file.filename().string() : file.filename().string();
}

}  // namespace study::looking
