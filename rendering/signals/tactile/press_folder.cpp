#include "rendering/signals/tactile/press_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "protocols/files/errors.h"
#include "rendering/images/image_io.h"

namespace rendering {

namespace {

namespace fs = std::filesystem;

std::string endingOf(const fs::path& file)
{
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

/// A Mac puts "._NAME.png", which is no picture, beside each picture on a stick.
bool isPicture(const fs::path& file)
{
    if (file.filename().string().starts_with('.')) return false;
    constexpr std::array<std::string_view, 6> endings{".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
    return std::find(endings.begin(), endings.end(), endingOf(file)) != endings.end();
}

/// Of all pictures of a folder. A press of a GelSight Mini has 8 million.
constexpr std::size_t mostPixels = 420'000'000;

bool isBackground(const fs::path& file)
{
    return file.stem() == "background" || file.stem() == "reference" || file.stem() == "tactile-reference";
}

std::vector<fs::path> picturesIn(const fs::path& folder)
{
    std::error_code failed;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, failed))
        if (entry.is_regular_file() && isPicture(entry.path())) files.push_back(entry.path());
    if (failed)
        throw protocols::badInput({.what = "the folder of presses cannot be read (" + failed.message() + ")",
                                   .where = folder.string(),
                                   .expected = "a folder with background.png and one picture for each press",
                                   .nextStep = "check the path and its permissions"});
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

cv::Mat readPicture(const fs::path& file, const Decode& decodeOther)
{
    const std::string ending = endingOf(file);
    if (ending == ".tif" || ending == ".tiff") return readColourTiff(file);
    const bool own = ending == ".png" || ending == ".npy" || ending == ".pgm";
    return own || !decodeOther ? readImage(file) : decodeOther(file);
}

signals::BallPresses readBallPresses(const fs::path& folder, double ballRadiusMm, double mmPerPixel, const Decode& decodeOther)
{
    signals::BallPresses presses;
    presses.ballRadiusMm = ballRadiusMm;
    presses.mmPerPixel = mmPerPixel;
    std::size_t pixels = 0;
    for (const auto& file : picturesIn(folder)) {
        cv::Mat picture = readPicture(file, decodeOther);
        pixels += picture.total();
        if (pixels > mostPixels)
            throw protocols::badInput({.what = "the pictures have more pixels together than are read",
                                       .where = file.string(),
                                       .expected = "at most " + std::to_string(mostPixels / 1000000) +
                                                   " million pixels, such as 50 presses of 3280 x 2464",
                                       .nextStep = "use fewer presses, or smaller pictures of all"});
        if (isBackground(file))
            presses.background = picture;
        else
            presses.presses.push_back({file.filename().string(), picture});
    }
    if (presses.background.empty() || presses.presses.empty())
        throw protocols::badInput(
            {.what = presses.background.empty() ? "the folder has no frame of the untouched sensor" : "the folder has no press",
             .where = folder.string(),
             .expected = "background.png and one picture for each press",
             .nextStep = "add the missing pictures"});
    for (const auto& press : presses.presses)
        if (press.frame.size() != presses.background.size() || press.frame.type() != presses.background.type())
            throw protocols::badInput({.what = "differs from the background in size or type",
                                       .where = (folder / press.name).string(),
                                       .expected = std::to_string(presses.background.cols) + " x " +
                                                   std::to_string(presses.background.rows) +
                                                   " pixels, colour, with the same number of bits",
                                       .nextStep = "remove the picture, or save it like the others"});
    return presses;
}

}  // namespace rendering
