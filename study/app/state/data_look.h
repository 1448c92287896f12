// Contents of the page that shows a data set, and the functions that supply them, as values. The window itself opens no
// signal file. main and the tests assemble the functions.
#pragma once

#include <QImage>
#include <QString>
#include <QStringList>
#include <filesystem>
#include <functional>
#include <vector>

#include "study/app/state/appearance.h"

namespace study::app {

struct DataOverview {
    struct Fabric {
        QString id, name, structure;
        int photographs = 0, frames = 0, heights = 0, strokes = 0;
        int samples = 0;  ///< number of samples of the signal that has most
    };
    QString name;
    QString about;  ///< one line: pairing, scale, strokes, licence
    std::vector<Fabric> fabrics;
};

struct DataSheetRequest {
    std::filesystem::path folder;
    QString fabric;
    int sample = 0;  ///< from 0
    Theme theme = Theme::Light;
    int widthPx = 900;   ///< width of the picture, px
    double fontPx = 15;  ///< size of plain text, px
    double pixelRatio = 1;
};

struct DataSheet {
    QImage picture;       ///< empty if no signal could be read
    QString description;  ///< the numbers of the picture as text
    QStringList faults;   ///< signals that could not be read, with the reason
};

/// Functions that read a data set. Each throws protocols::Error and may be called on any thread. Each refuses files that
/// belong to an open study.
struct LookAtData {
    std::function<DataOverview(const std::filesystem::path& folder)> open;
    std::function<DataSheet(const DataSheetRequest&)> draw;
    /// Lists every fault of the files, each with its file. `progress` receives the share done (0..1) and throws to stop.
    std::function<QStringList(const std::filesystem::path& folder, const std::function<void(double)>& progress)> check;

    explicit operator bool() const { return open && draw && check; }
};

}  // namespace study::app
