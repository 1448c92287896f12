#include "study/looking/trace_panels.h"

#include <QFontMetricsF>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "rendering/signals/spectrogram.h"
#include "study/looking/relief_picture.h"

namespace study::looking {

namespace {

constexpr std::size_t fewestSamples = 32;   // needed for a spectrogram
constexpr std::size_t mostSamples = 20000;  // more than a panel can show
constexpr double shownDecades = 3;          // 60 dB

/// Part of a trace for a spectrogram: at most `mostSamples` from the middle, minus the mean, with 0 in gaps.
struct TraceExcerpt {
    std::vector<double> values;
    std::size_t first = 0;
    bool isWhole = true;
};

TraceExcerpt excerptOf(const SeenTrace& trace)
{
    const std::size_t count = std::min(trace.values.size(), mostSamples);
    TraceExcerpt excerpt{{}, (trace.values.size() - count) / 2, count == trace.values.size()};
    const auto begin = trace.values.begin() + static_cast<std::ptrdiff_t>(excerpt.first);
    excerpt.values.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    double sum = 0, finite = 0;
    for (const double value : excerpt.values)
        if (std::isfinite(value)) {
            sum += value;
            ++finite;
        }
    const double mean = finite > 0 ? sum / finite : 0;
    for (double& value : excerpt.values) value = std::isfinite(value) ? value - mean : 0;
    return excerpt;
}

/// Scale of frequencies: per second; per mm if only places are known; otherwise per sample.
struct FrequencyScale {
    double perSample = 1;
    QString unit;
};

FrequencyScale frequenciesOf(const SeenTrace& trace)
{
    if (trace.sampleRateHz) return {*trace.sampleRateHz, QStringLiteral("Hz")};
    if (trace.samplesPerMm) return {*trace.samplesPerMm, QStringLiteral("per mm")};
    return {1, QStringLiteral("per sample")};
}

rendering::signals::Spectrogram spectrogramOf(const TraceExcerpt& excerpt)
{
    rendering::signals::SpectrogramParameters parameters;
    int window = 32;
    while (window < 512 && static_cast<std::size_t>(window) * 16 < excerpt.values.size()) window *= 2;
    parameters.windowLength = parameters.fftSize = window;
    parameters.hop = window / 4;
    return rendering::signals::stft(excerpt.values, parameters);
}

/// Amplitudes of sines, CV_64FC1 [frequency × frame]. The factor 4 / length corrects for the Hann window, whose mean is 0.5.
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
                     QStringLiteral("%1 samples are too few for a spectrum").arg(trace.values.size()));
    return true;
}

QString withUnit(const SeenTrace& trace) { return QString::fromStdString(trace.quantity); }

}  // namespace

void drawTrace(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style)
{
    const QRectF below = belowCaption(painter, place, QStringLiteral("Trace"), style);
    const double length = trace.places.back() - trace.places.front();
    const PlotAxis x{trace.places.front(), trace.places.front() + (length > 0 ? length : 1),
                     QString::fromStdString(trace.placeUnit)};
    const PlotAxis y = axisAround(trace.values, withUnit(trace));
    drawCurve(painter, drawAxes(painter, below, x, y, style), x, y, trace.places, trace.values, style);
}

void drawSpectrogram(QPainter& painter, const QRectF& place, const SeenTrace& trace, const SheetStyle& style)
{
    const TraceExcerpt excerpt = excerptOf(trace);
    const QString part = excerpt.isWhole ? QString() : QStringLiteral(" of %1 samples").arg(excerpt.values.size());
    const QRectF below = belowCaption(painter, place, QStringLiteral("Spectrogram%1, 60 dB").arg(part), style);
    if (isTooShort(painter, below, trace, style)) return;
    const cv::Mat amplitudes = amplitudesOf(spectrogramOf(excerpt));
    double strongest = 0;
    cv::minMaxLoc(amplitudes, nullptr, &strongest);
    cv::Mat levels(amplitudes.size(), CV_32FC1);
    for (int row = 0; row < levels.rows; ++row)
        for (int column = 0; column < levels.cols; ++column)  // low frequencies at the bottom
            levels.at<float>(levels.rows - 1 - row, column) =
                strongest > 0 ? static_cast<float>(
                                    std::max(-shownDecades, std::log10(amplitudes.at<double>(row, column) / strongest + 1e-12)))
                              : -3.0f;
    const FrequencyScale frequencies = frequenciesOf(trace);
    const double first = trace.places[excerpt.first], last = trace.places[excerpt.first + excerpt.values.size() - 1];
    const PlotAxis x{first, last, QString::fromStdString(trace.placeUnit)}, y{0, frequencies.perSample / 2, frequencies.unit};
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
    const cv::Mat amplitudes = amplitudesOf(spectrogramOf(excerptOf(trace)));
    const FrequencyScale frequencies = frequenciesOf(trace);
    std::vector<double> places, logarithms;
    for (int row = 1; row < amplitudes.rows; ++row) {
        places.push_back(row * frequencies.perSample / (2.0 * (amplitudes.rows - 1)));
        const double power = cv::norm(amplitudes.row(row), cv::NORM_L2SQR) / amplitudes.cols;
        logarithms.push_back(std::log10(std::max(std::sqrt(power), 1e-15)));
    }
    const double highest = *std::max_element(logarithms.begin(), logarithms.end());
    const double lowest = std::max(*std::min_element(logarithms.begin(), logarithms.end()), highest - 6);
    const PlotAxis x{0, places.back(), frequencies.unit},
        y{std::floor(lowest), std::max(std::ceil(highest), std::floor(lowest) + 1), withUnit(trace), true};
    drawCurve(painter, drawAxes(painter, below, x, y, style), x, y, places, logarithms, style);
}

}  // namespace study::looking
