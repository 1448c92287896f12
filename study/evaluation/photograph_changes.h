// How much the generated signals of a photograph change where only the photograph changes: dye, light, exposure, focus, noise.
// The cloth stays, so relief and friction should stay.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// A change of a photograph (CV_8UC3, RGB) that leaves the cloth as it is.
struct PhotographChange {
    std::string name;
    cv::Mat (*of)(const cv::Mat& rgb);
};

/// Dyed red, dyed navy, blurred by 1 px, half exposure, noise of 8 levels, gamma 1.4, uneven lamp, JPEG of quality 50, grey.
const std::vector<PhotographChange>& photographChanges();

/// What a change did, over the photographs of a data set.
struct ChangeRow {
    std::string name;
    double friction = 0, worstFriction = 0;        ///< relative change of the mean friction: mean, and largest
    double correlation = 0, worstCorrelation = 0;  ///< of relief with that of the unchanged photograph, high-passed at 16 px
    /// Share of the changed photographs whose 90 % interval holds the friction of the unchanged one; nullopt: no intervals.
    std::optional<double> covered;
    bool met() const { return friction <= mostFrictionChange && correlation >= leastCorrelation; }
    static constexpr double mostFrictionChange = 0.06, leastCorrelation = 0.9;
};

struct ChangeReport {
    std::string dataset, model;
    int photographs = 0;
    std::vector<ChangeRow> rows;  ///< in the order of photographChanges()
};

/// Changes at most `request.samplesPerFabric` photographs of each fabric (1 if not set), the first ones. Throws badInput where
/// there are none.
ChangeReport evaluateChanges(const rendering::fabrics::Dataset& dataset, const EvaluationRequest& request,
                             const Report& report = {}, const Generate& generate = rendering::models::generate);

/// The report as JSON, schema vis2hap.evaluation/1.
nlohmann::ordered_json changesJson(const ChangeReport& changes);
std::string changesText(const ChangeReport& changes);

}  // namespace study::evaluation
