#include "rendering/models/training_log.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "protocols/files/folder_draft.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_png.h"
#include "rendering/models/training_curves.h"

namespace rendering::models {

namespace {

namespace fs = std::filesystem;

std::string pictureName(int step)
{
    const std::string number = std::to_string(step);
    return "samples-" + std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number + ".png";
}

/// Step in the name of a picture of a log; nullopt for other names.
std::optional<int> stepOfPicture(const std::string& name)
{
    const std::string before = "samples-", after = ".png";
    int step = 0;
    if (!name.starts_with(before) || !name.ends_with(after)) return {};
    const char* end = name.data() + name.size() - after.size();
    const auto read = std::from_chars(name.data() + before.size(), end, step);
    return read.ec == std::errc() && read.ptr == end ? std::optional(step) : std::nullopt;
}

void removePicturesAfter(const fs::path& folder, int step)
{
    std::vector<fs::path> gone;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (const auto taken = stepOfPicture(entry.path().filename().string()); taken && *taken > step)
            gone.push_back(entry.path());
    for (const fs::path& file : gone) fs::remove(file);
}

}  // namespace

std::filesystem::path logOf(const std::filesystem::path& model)
{
    std::filesystem::path folder = model;
    folder += ".log";
    return folder;
}

TrainingLog::TrainingLog(fs::path folder, std::optional<int> resumeAtStep) : m_folder(std::move(folder))
{
    protocols::makeFolders(m_folder);
    removePicturesAfter(m_folder, resumeAtStep.value_or(-1));
    if (!resumeAtStep) {
        for (const char* name : {"losses.csv", "validation.csv", "curves.svg"}) fs::remove(m_folder / name);
        return;
    }
    m_losses = readTrainingTable(m_folder / "losses.csv");
    m_validation = readTrainingTable(m_folder / "validation.csv");
    m_losses.dropAfter(*resumeAtStep);
    m_validation.dropAfter(*resumeAtStep);
    writeTables();
}

void TrainingLog::writeTables() const
{
    protocols::writeWholeFile(m_folder / "losses.csv", csvText(m_losses));
    protocols::writeWholeFile(m_folder / "validation.csv", csvText(m_validation));
    protocols::writeWholeFile(m_folder / "curves.svg", curvesSvg(m_losses, m_validation));
}

void TrainingLog::losses(int step, std::span<const NamedValue> values)
{
    m_losses.put(step, values);
    protocols::writeWholeFile(m_folder / "losses.csv", csvText(m_losses));
}

void TrainingLog::validation(int step, std::span<const NamedValue> values)
{
    m_validation.put(step, values);
    writeTables();
}

void TrainingLog::pictures(int step, std::span<const SampleRow> rows)
{
    if (!rows.empty()) writePng(m_folder / pictureName(step), samplePicture(step, rows));
}

std::string sparkline(std::span<const double> values, int most)
{
    const std::size_t together =
        std::max<std::size_t>(1, (values.size() + static_cast<std::size_t>(most) - 1) / static_cast<std::size_t>(most));
    std::vector<double> means;
    for (std::size_t from = 0; from < values.size(); from += together) {
        const std::size_t end = std::min(values.size(), from + together);
        double sum = 0;
        for (std::size_t i = from; i < end; ++i) sum += values[i] / static_cast<double>(end - from);
        means.push_back(sum);
    }
    double low = INFINITY, high = -INFINITY;
    for (const double mean : means)
        if (std::isfinite(mean)) {
            low = std::min(low, mean);
            high = std::max(high, mean);
        }
    std::string line;
    for (const double mean : means) {
        const int level = high > low ? static_cast<int>(std::lround(7 * (mean - low) / (high - low))) : 3;
        line += std::isfinite(mean) ? std::string("\xE2\x96") + static_cast<char>(0x81 + level) : std::string(" ");
    }
    return line;
}

}  // namespace rendering::models
