// A signal to be shown on a sheet: a map (photograph, tactile frame, height, gradient, friction image) or a trace (friction over
// a stroke), with unit and pitch. Also the figures and warnings that reveal a bad recording.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace study::looking {

/// Range of numbers that the file format can store. Pixels at either end are clipped.
struct StoredRange {
    double lowest = 0, highest = 255;
};

struct SeenMap {
    cv::Mat values;                    ///< CV_32FC1; NaN: missing. A colour picture has its grey values here
    cv::Mat colours;                   ///< CV_8UC3, RGB; empty if the file has one channel
    cv::Mat clipped;                   ///< CV_8UC1, not 0 where a channel is clipped; empty without `storedRange`
    std::string unit;                  ///< "mm", "mm/mm", "grey level"
    std::optional<double> mmPerPixel;  ///< pitch along a row
    double rowPitch = 1;               ///< pitch from row to row, relative to the pitch along a row
    bool beginsAtZero = false;         ///< true for heights of a data set, whose lowest points are 0
    std::optional<StoredRange> storedRange;
};

struct SeenTrace {
    std::vector<double> places;          ///< place of each sample, increasing, in `placeUnit`
    std::vector<double> values;          ///< NaN: missing
    std::string placeUnit;               ///< "mm", "s", "samples"
    std::string quantity;                ///< "coefficient of friction", or the name in the record
    std::optional<double> sampleRateHz;  ///< mean rate of the samples that are shown
    std::optional<double> samplesPerMm;
    std::string whyMissing = "not a number";
    std::size_t droppedRows = 0;  ///< rows that are not shown, because their place is missing or does not increase
};

struct SeenSignal {
    std::string title;  ///< "F03 000.png"
    std::string kind;   ///< "photograph, 512 × 512, 8 bits"
    std::variant<SeenMap, SeenTrace> what;
};

/// Figures of the finite values. A signal without finite values has no minimum, maximum, mean and sq.
struct SignalFacts {
    std::optional<double> min, max, mean;
    std::optional<double> sq;                                 ///< RMS deviation from the mean; Sq of a surface
    double missingShare = 0;                                  ///< share of values that are not finite or marked as missing
    std::optional<double> clippedLowShare, clippedHighShare;  ///< shares of the pixels; none without `storedRange`
    bool operator==(const SignalFacts&) const = default;
};
SignalFacts factsOf(const SeenSignal& signal);

/// The figures as lines of text with units: "min 0.012  max 0.410 mm", "Sq 0.055 mm".
std::vector<std::string> linesOf(const SeenSignal& signal, const SignalFacts& facts);
/// Warnings for the experimenter, one sentence each; empty if the signal looks normal.
std::vector<std::string> warningsOf(const SeenSignal& signal, const SignalFacts& facts);

/// Number with three significant digits: "0.0551", "12.3", "1.28e+06".
std::string figure(double value);
/// Number with at most two significant digits and no trailing zeros: "0.05", "12".
std::string roughFigure(double value);

}  // namespace study::looking
