#include "study/making/own/own_images.h"

#include <opencv2/core.hpp>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "rendering/composition/friction_image.h"
#include "rendering/images/image_io.h"

namespace study::making {

namespace {

namespace fs = std::filesystem;

constexpr const char* endings[] = {".png", ".tif", ".tiff", ".pgm", ".npy"};

std::optional<fs::path> fileOf(const fs::path& folder, const protocols::FabricId& fabric)
{
    for (const char* ending : endings)
        if (fs::path file = folder / (fabric.value + ending); fs::is_regular_file(file)) return file;
    return std::nullopt;
}

void requireFiles(const protocols::ConditionId& condition, const fs::path& folder,
                  const std::vector<protocols::FabricId>& fabrics)
{
    const std::string which = "condition '" + condition.value + "'";
    if (!fs::is_directory(folder))
        throw protocols::badInput({"the folder of the images of " + which + " is missing", folder.string(),
                                   "a folder with one image for each fabric", "correct \"images\" in the protocol"});
    std::string missing;
    std::size_t count = 0;
    for (const auto& fabric : fabrics)
        if (!fileOf(folder, fabric)) {
            missing += (missing.empty() ? "" : ", ") + fabric.value + ".png";
            ++count;
        }
    if (count > 0)
        throw protocols::badInput(
            {which + " lacks " + std::to_string(count) + " of " + std::to_string(fabrics.size()) + " images: " + missing,
             folder.string(), "one image for each fabric of the study",
             "add the images, or name only their fabrics in the protocol"});
}

cv::Mat readOwn(const fs::path& file)
{
    cv::Mat image = rendering::readImage(file);
    if (const std::string fault = faultOfOwnImage(image); !fault.empty())
        throw protocols::badInput({"the image has " + fault, file.string(), expectedOwnImage(), "convert the image"});
    return image;
}

}  // namespace

std::string expectedOwnImage()
{
    return std::to_string(rendering::displayWidthPx) + " x " + std::to_string(rendering::displayHeightPx) +
           " pixels of the display, 1 channel of 8 bits (bright: high friction)";
}

std::string faultOfOwnImage(const cv::Mat& image)
{
    const bool fits =
        image.type() == CV_8UC1 && image.cols == rendering::displayWidthPx && image.rows == rendering::displayHeightPx;
    if (fits) return {};
    return std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels, " + std::to_string(image.channels()) +
           (image.channels() == 1 ? " channel" : " channels") + " of " + std::to_string(8 * image.elemSize1()) + " bits";
}

void addOwnImages(OwnImages& own, const protocols::ConditionId& condition, std::map<protocols::FabricId, cv::Mat> images)
{
    std::string bytes;
    for (const auto& [fabric, image] : images) {
        double least = 0, most = 0;
        cv::minMaxLoc(image, &least, &most);
        if (least == most)
            own.warnings.push_back("the image of " + fabric.value + " under " + condition.value +
                                   " has one level: no participant can feel a texture on it");
        bytes += rendering::pgmBytes(image);
    }
    own.sha256[condition.value] = protocols::sha256(bytes);
    own.images[condition] = std::move(images);
}

OwnImages readOwnImages(const protocols::Protocol& protocol, const fs::path& beside,
                        const std::vector<protocols::FabricId>& fabrics)
{
    OwnImages own;
    for (const auto& [condition, name] : protocol.ownImages) {
        const fs::path folder = fs::path(name).is_absolute() ? fs::path(name) : beside / name;
        requireFiles(condition, folder, fabrics);
        std::map<protocols::FabricId, cv::Mat> images;
        for (const auto& fabric : fabrics) images[fabric] = readOwn(*fileOf(folder, fabric));
        addOwnImages(own, condition, std::move(images));
    }
    return own;
}

}  // namespace study::making
