// The way from photographs to a data set, as values, and the functions that do its steps. The window itself opens no image
// file. main and the tests assemble the functions.
#pragma once

#include <QImage>
#include <QSize>
#include <QStringList>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/app/state/appearance.h"
#include "study/app/state/study_tool.h"

namespace study::app {

/// A photograph for the window.
struct SeenPhotograph {
    QImage picture;  ///< scaled down
    QSize sizePx;    ///< size of the photograph itself
};

struct NamedPhotograph {
    std::filesystem::path file;
    std::string fabric;  ///< name of its fabric
    bool operator==(const NamedPhotograph&) const = default;
};

/// The photographs of a new data set. Those of one fabric stand side by side.
struct PhotographSet {
    std::vector<NamedPhotograph> photographs;
    std::optional<double> mmPerPixel;  ///< of every photograph; empty: unknown
    bool operator==(const PhotographSet&) const = default;
};

/// Bounds of the width of one pixel, mm: a microscope, and a picture in which no thread can be seen any more.
inline constexpr double leastMmPerPixel = 0.0005, mostMmPerPixel = 1;

struct FrictionPictureRequest {
    std::filesystem::path dataset;
    std::vector<std::string> conditions;  ///< ids
    QStringList captions;                 ///< one for each condition
    Theme theme = Theme::Light;
    int widthPx = 900;   ///< width of the picture, px
    double fontPx = 15;  ///< size of plain text, px
    double pixelRatio = 1;
};

/// Each function throws protocols::Error and is called on a worker thread. `progress` throws to stop the work.
struct PhotographSteps {
    /// The file itself, or all image files in the folder and its sub-folders, in order of their paths.
    std::function<std::vector<std::filesystem::path>(const std::filesystem::path& place)> find;
    /// Reads one photograph. `mostPx`: largest side of the picture.
    std::function<SeenPhotograph(const std::filesystem::path& file, int mostPx)> see;
    /// Warnings about each photograph, in their order: what the generators cannot use as it is.
    std::function<std::vector<QStringList>(const PhotographSet& set, const ToolProgress& progress)> check;
    /// Writes the data set into a folder that does not exist yet. Leaves nothing half-made.
    std::function<void(const PhotographSet& set, const std::filesystem::path& folder, const ToolProgress& progress)> write;
    /// Renders friction images of all fabrics of the data set and draws them: a row for each fabric, a column for each condition.
    std::function<QImage(const FrictionPictureRequest& request, const ToolProgress& progress)> draw;

    /// Writes the protocol of a study of this data set under these conditions, with the usual texts of a language, and returns
    /// its path.
    std::function<std::filesystem::path(const std::filesystem::path& dataset, const std::vector<std::string>& conditions,
                                        const std::string& language)>
        plan;

    explicit operator bool() const { return find && see && check && write && draw && plan; }
};

}  // namespace study::app
