#include "study/looking/place_in_dataset.h"

#include <charconv>

namespace study::looking {

namespace fs = std::filesystem;

std::optional<PlaceInDataset> placeInDataset(const fs::path& file)
{
    std::error_code problem;
    const fs::path whole = fs::weakly_canonical(file, problem);
    const fs::path signal = whole.parent_path(), fabric = signal.parent_path();
    if (!fs::exists(fabric.parent_path() / "dataset.json", problem)) return std::nullopt;
    const std::string stem = whole.stem().string();
    int index = -1;
    if (const auto [end, fault] = std::from_chars(stem.data(), stem.data() + stem.size(), index);
        fault != std::errc{} || end != stem.data() + stem.size())
        index = -1;
    return PlaceInDataset{rendering::fabrics::readDataset(fabric.parent_path()), fabric.filename().string(),
                          signal.filename().string(), index};
}

std::string titleOf(const fs::path& file, const std::optional<PlaceInDataset>& place)
{
    return place ? place->fabric + " " + place->signal + " " + file.filename().string() : file.filename().string();
}

}  // namespace study::looking
