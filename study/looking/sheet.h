// Signals side by side on one sheet: each as picture, relief and profile (traces: curve, spectrogram, spectrum), with
// units, a scale bar and the figures by which a bad press or a clipped image is seen.
#pragma once

#include <QImage>

#include "study/looking/plot.h"
#include "study/looking/seen_signal.h"

namespace study::looking {

/// At most this many signals stand in a row.
inline constexpr int signalsInARow = 4;

/// `signals` must not be empty; `perRow` from 1. A QGuiApplication must exist; any thread. Throws badInput where the sheet
/// would be larger than a picture can be.
QImage drawSheet(const std::vector<SeenSignal>& signals, const SheetStyle& style, int perRow = signalsInARow);

/// What the sheet tells, in words: for screen readers and for standard output.
QString describe(const std::vector<SeenSignal>& signals);

}  // namespace study::looking
