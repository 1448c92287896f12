// A signal as it is looked at: a map (photograph, tactile frame, height, gradient, friction image) or a trace
// (friction over a stroke), with its unit and pitch, and the figures by which a bad recording is seen.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace study::looking {

/// What the file's own numbers can hold: pixels at either end are clipped.
struct Holds {
    double lowest = 0, highest = 255;
};

struct SeenMap {
    cv::Mat values;                    ///< CV_32FC1; NaN where the file has nothing. Of a colour picture: its grey
    cv::Mat colours;                   ///< CV_8UC3, RGB; empty where the file has one channel
    cv::Mat clipped;                   ///< CV_8UC1, not 0 where any channel is at an end; empty without `holds`
    std::string unit;                  ///< "mm", "mm/mm", "grey level"
    std::optional<double> mmPerPixel;  ///< along a row
    double rowPitch = 1;               ///< from row to row, in pitches along a row
    bool beginsAtZero = false;         ///< the lowest places of a data set's heights are 0
    std::optional<Holds> holds;
};

struct SeenTrace {
    std::vector<double> places;          ///< of the samples, rising, in `placeUnit`
    std::vector<double> values;          ///< NaN where there is none
    std::string placeUnit;               ///< "mm", "s", "samples"
    std::string quantity;                ///< "coefficient of friction", or the record's own name
    std::optional<double> sampleRateHz;  ///< on the average
    std::optional<double> samplesPerMm;
    std::string whyMissing = "no number";
};

struct SeenSignal {
    std::string title;  ///< "F03 000.png"
    std::string kind;   ///< "photograph, 512 × 512, 8 bits"
    std::variant<SeenMap, SeenTrace> what;
};

/// Figures of the finite values; a signal without any has none of the first five.
struct SignalFacts {
    std::optional<double> min, max, mean;
    std::optional<double> sq;                                 ///< root mean square about the mean (of a surface: Sq)
    double missingShare = 0;                                  ///< not finite, or marked as missing
    std::optional<double> clippedLowShare, clippedHighShare;  ///< of the pixels, where the file's numbers have ends
    bool operator==(const SignalFacts&) const = default;
};
SignalFacts factsOf(const SeenSignal& signal);

/// The figures as lines of text with units: "min 0.012  max 0.410 mm", "Sq 0.055 mm".
std::vector<std::string> linesOf(const SeenSignal& signal, const SignalFacts& facts);
/// What an experimenter should look at before going on, each a sentence; empty where nothing is odd.
std::vector<std::string> warningsOf(const SeenSignal& signal, const SignalFacts& facts);

/// Three significant digits: "0.0551", "12.3", "1.28e+06".
std::string figure(double value);
/// At most two, without noughts at the end: "0.05", "12".
std::string roughFigure(double value);

}  // namespace study::looking
