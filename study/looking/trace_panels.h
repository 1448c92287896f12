// Panels of a trace on a sheet. Each is drawn into a rectangle, with its caption at the top.
#pragma once

#include "study/looking/plot.h"
#include "study/looking/seen_signal.h"

namespace study::looking {

/// Curve of the trace.
void drawTrace(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style);
/// Spectrogram of the trace, or of its middle part if it is very long. A note replaces it if the trace is too short.
void drawSpectrogram(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style);
/// Mean amplitude spectrum of the same part, with the same note for a short trace.
void drawSpectrum(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style);

}  // namespace study::looking
