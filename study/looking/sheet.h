// Sheet with several signals side by side. A map has a picture, a relief and a profile; a trace has a curve, a spectrogram and a
// spectrum. Each has units, a scale bar, and the figures that reveal a bad press or a clipped image.
#pragma once

#include <QImage>

#include "study/looking/plot.h"
#include "study/looking/seen_signal.h"

namespace study::looking {

/// Largest number of signals in a row.
inline constexpr int signalsInARow = 4;

/// Draws the sheet. `signals` must not be empty; `perRow` ≥ 1. A QGuiApplication must exist; works on any thread. Throws badInput
/// if the sheet exceeds the largest picture size.
QImage drawSheet(const std::vector<SeenSignal>& signals, const SheetStyle& style, int perRow = signalsInARow);

/// Contents of the sheet as text, for screen readers and for standard output.
QString describe(const std::vector<SeenSignal>& signals);

}  // namespace study::looking
