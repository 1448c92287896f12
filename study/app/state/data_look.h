// What the page for looking at a data set shows, and the functions that get it, as values: this window opens no signal
// itself. main and tests put them together.
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
        int samples = 0;  ///< the most of any signal
    };
    QString name;
    QString about;  ///< pairing, scale, strokes, licence: a line
    std::vector<Fabric> fabrics;
};

struct DataSheetRequest {
    std::filesystem::path folder;
    QString fabric;
    int sample = 0;  ///< from 0
    Theme theme = Theme::Light;
    int widthPx = 900;   ///< to fill
    double fontPx = 15;  ///< of plain text
    double pixelRatio = 1;
};

struct DataSheet {
    QImage picture;       ///< empty where no signal could be read
    QString description;  ///< its figures in words
    QStringList faults;   ///< what could not be read
};

/// Each throws protocols::Error, may be called on any thread, and refuses what belongs to an open study.
struct LookAtData {
    std::function<DataOverview(const std::filesystem::path& folder)> open;
    std::function<DataSheet(const DataSheetRequest&)> draw;
    /// Every fault of the files, with its file. `progress` hears the share done, and throws to stop.
    std::function<QStringList(const std::filesystem::path& folder, const std::function<void(double)>& progress)> check;

    explicit operator bool() const { return open && draw && check; }
};

}  // namespace study::app
