#include "rendering/display/display.h"

#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "rendering/composition/friction_image.h"
#include "rendering/display/external_display.h"
#include "rendering/images/image_io.h"

namespace rendering {

namespace {

class NoDisplay : public HapticDisplay {
public:
    void show(const cv::Mat&) override {}
    void clear() override {}
    std::string name() const override { return "none"; }
    bool isThere() const override { return false; }
};

class FolderDisplay : public HapticDisplay {
public:
    explicit FolderDisplay(std::filesystem::path folder) : m_folder(std::move(folder)) {}

    void show(const cv::Mat& frictionImage) override
    {
        const auto current = m_folder / "current.pgm";
        try {
            writePgm(current, frictionImage, protocols::Sync::Later);  // The image is not needed after the session.
        } catch (const std::exception& fault) {
            throw protocols::workFailed(
                {.what = std::string("the image cannot be written into the display's folder (") + fault.what() + ")",
                 .where = current.string(),
                 .expected = "a writable folder",
                 .nextStep = "free space or correct the permissions, then show the image again"});
        }
    }

    void clear() override { show(cv::Mat::zeros(displayHeightPx, displayWidthPx, CV_8UC1)); }
    std::string name() const override { return "folder:" + m_folder.string(); }

private:
    std::filesystem::path m_folder;
};

std::unique_ptr<HapticDisplay> openFolder(const std::filesystem::path& folder)
{
    protocols::makeFolders(folder);
    auto display = std::make_unique<FolderDisplay>(folder);
    display->clear();  // The image of an earlier session must not be felt.
    return display;
}

}  // namespace

std::unique_ptr<HapticDisplay> openDisplay(const std::string& specification, const std::stop_token& stop)
{
    const std::string folderKind = "folder:";
    if (specification == "none") return std::make_unique<NoDisplay>();
    if (specification.starts_with(folderKind) && specification.size() > folderKind.size())
        return openFolder(specification.substr(folderKind.size()));
    if (const auto address = driverAddressFrom(specification))
        return std::make_unique<ExternalDisplay>(*address, DriverPatience{.stop = stop});
    throw protocols::badInput({.what = "unknown display '" + specification + "'",
                               .where = "",
                               .expected = "none, folder:DIR, exec:COMMAND or tcp:HOST:PORT",
                               .nextStep = "correct the name of the display"});
}

cv::Size sessionImagePx() { return {displayWidthPx, displayHeightPx}; }

bool hasDriver(const std::string& specification)
{
    return specification.starts_with("exec:") || specification.starts_with("tcp:");
}

}  // namespace rendering
