// The panels of a sheet, each drawn into a rectangle with its caption on top.
#pragma once

#include "study/looking/plot.h"
#include "study/looking/seen_signal.h"

namespace study::looking {

void drawPicture(QPainter& painter, const QRectF& place, const SeenMap& map, const SignalFacts& facts, const SheetStyle& style);
void drawRelief(QPainter& painter, const QRectF& place, const SeenMap& map, const SheetStyle& style);
/// Along the row in the middle.
void drawProfile(QPainter& painter, const QRectF& place, const SeenMap& map, const SheetStyle& style);

void drawTrace(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style);
/// Of the whole record, or of its middle where it is very long. What is too short for one says so.
void drawSpectrogram(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style);
void drawSpectrum(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style);

}  // namespace study::looking
