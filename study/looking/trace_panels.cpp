// The panels of a trace. Spectrograms are those of rendering/signals, drawn.
#include <QFontMetricsF>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "rendering/signals/spectrogram.h"
#include "study/looking/relief_picture.h"
#include "study/looking/sheet_panels.h"

namespace study::looking {

namespace {

constexpr std::size_t fewestSamples = 32;   // for a spectrogram
constexpr std::size_t mostSamples = 20000;  // more than a panel can show
constexpr double shownDecades = 3;          // 60 dB

/// What spectrograms are taken of: without gaps, about its mean, at most `mostSamples` from the middle.
struct Stretch {
    std::vector<double> values;
    std::size_t first = 0;
    bool isWhole = true;
};

Stretch stretchOf(const SeenTrace& trace)
{
    const std::size_t count = std::min(trace.values.size(), mostSamples);
    Stretch stretch{{}, (trace.values.size() - count) / 2, count == trace.values.size()};
    const auto begin = trace.values.begin() + static_cast<std::ptrdiff_t>(stretch.first);
    stretch.values.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    double sum = 0, finite = 0;
    for (const double value : stretch.values)
        if (std::isfinite(value)) {
            sum += value;
            ++finite;
        }
    const double mean = finite > 0 ? sum / finite : 0;
    for (double& value : stretch.values) value = std::isfinite(value) ? value - mean : 0;
    return stretch;
}

/// Frequencies count per second, per mm where only places are known, else per sample.
struct Frequencies {
    double perSample = 1;
    QString unit;
};

Frequencies frequenciesOf(const SeenTrace& trace)
{
    if (trace.sampleRateHz) return {*trace.sampleRateHz, QStringLiteral("Hz")};
    if (trace.samplesPerMm) return {*trace.samplesPerMm, QStringLiteral("per mm")};
    return {1, QStringLiteral("per sample")};
}

rendering::signals::Spectrogram spectrogramOf(const Stretch& stretch)
{
    rendering::signals::SpectrogramParameters parameters;
    int window = 32;
    while (window < 512 && static_cast<std::size_t>(window) * 16 < stretch.values.size()) window *= 2;
    parameters.windowLength = parameters.fftSize = window;
    parameters.hop = window / 4;
    return rendering::signals::stft(stretch.values, parameters);
}

/// Amplitudes of sines, CV_64FC1 [frequency x frame]: a Hann window weighs half of its length.
cv::Mat amplitudesOf(const rendering::signals::Spectrogram& spectrogram)
{
    std::vector<cv::Mat> parts;
    cv::split(spectrogram.values, parts);
    cv::Mat size;
    cv::magnitude(parts[0], parts[1], size);
    return size * (4.0 / spectrogram.parameters.windowLength);
}

bool isTooShort(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style)
{
    if (trace.values.size() >= fewestSamples) return false;
    painter.setFont(fontOf(style, 0.9));
    painter.setPen(style.quietText);
    painter.drawText(place, Qt::AlignCenter | Qt::TextWordWrap,
                     QStringLiteral("%1 samples are too few for this").arg(trace.values.size()));
    return true;
}

QString withUnit(const SeenTrace& trace) { return QString::fromStdString(trace.quantity); }

}  // namespace

void drawTrace(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style)
{
    const QRectF below = belowCaption(painter, place, QStringLiteral("Trace"), style);
    const double length = trace.places.back() - trace.places.front();
    const Axis x{trace.places.front(), trace.places.front() + (length > 0 ? length : 1), QString::fromStdString(trace.placeUnit)};
    const Axis y = axisAround(trace.values, withUnit(trace));
    drawCurve(painter, drawAxes(painter, below, x, y, style), x, y, trace.places, trace.values, style);
}

void drawSpectrogram(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style)
{
    const Stretch stretch = stretchOf(trace);
    const QString part = stretch.isWhole ? QString() : QStringLiteral(" of %1 samples").arg(stretch.values.size());
    const QRectF below = belowCaption(painter, place, QStringLiteral("Spectrogram%1, 60 dB").arg(part), style);
    if (isTooShort(painter, below, trace, style)) return;
    const cv::Mat amplitudes = amplitudesOf(spectrogramOf(stretch));
    double strongest = 0;
    cv::minMaxLoc(amplitudes, nullptr, &strongest);
    cv::Mat levels(amplitudes.size(), CV_32FC1);
    for (int row = 0; row < levels.rows; ++row)
        for (int column = 0; column < levels.cols; ++column)  // low frequencies below
            levels.at<float>(levels.rows - 1 - row, column) =
                strongest > 0 ? static_cast<float>(
                                    std::max(-shownDecades, std::log10(amplitudes.at<double>(row, column) / strongest + 1e-12)))
                              : -3.0f;
    const Frequencies frequencies = frequenciesOf(trace);
    const double first = trace.places[stretch.first], last = trace.places[stretch.first + stretch.values.size() - 1];
    const Axis x{first, last, QString::fromStdString(trace.placeUnit)}, y{0, frequencies.perSample / 2, frequencies.unit};
    const QRectF inside = drawAxes(painter, below, x, y, style);
    painter.save();
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(inside.adjusted(1, 0, 0, 0), pictureOf(levels, -shownDecades, 0, Palette::Colours, style.attention));
    painter.restore();
}

void drawSpectrum(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style)
{
    const QRectF below = belowCaption(painter, place, QStringLiteral("Spectrum, mean amplitude"), style);
    if (isTooShort(painter, below, trace, style)) return;
    const cv::Mat amplitudes = amplitudesOf(spectrogramOf(stretchOf(trace)));
    const Frequencies frequencies = frequenciesOf(trace);
    std::vector<double> places, logarithms;
    for (int row = 1; row < amplitudes.rows; ++row) {
        places.push_back(row * frequencies.perSample / (2.0 * (amplitudes.rows - 1)));
        const double power = cv::norm(amplitudes.row(row), cv::NORM_L2SQR) / amplitudes.cols;
        logarithms.push_back(std::log10(std::max(std::sqrt(power), 1e-15)));
    }
    const double highest = *std::max_element(logarithms.begin(), logarithms.end());
    const double lowest = std::max(*std::min_element(logarithms.begin(), logarithms.end()), highest - 6);
    const Axis x{0, places.back(), frequencies.unit},
        y{std::floor(lowest), std::max(std::ceil(highest), std::floor(lowest) + 1), withUnit(trace), true};
    drawCurve(painter, drawAxes(painter, below, x, y, style), x, y, places, logarithms, style);
}

}  // namespace study::looking
