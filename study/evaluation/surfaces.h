// Evaluation on photographs with the surface that they show: generated relief against it, pixel by pixel, beside relief that
// needs no training (shape from shading, the photograph itself) and a ridge regression that never saw the fabric.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "stats/kernels/value.h"
#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// Correlation with the surface, both high-passed: at 16 px of the photograph, and at 4 mm where its scale is known.
struct SurfaceCorrelation {
    double at16Px = 0;
    std::optional<double> at4Mm;
};

/// Sources of relief, in the order of the table.
enum class SeenRelief { Generated, ShapeFromShading, Photograph, Ridge };
inline constexpr SeenRelief allSeenReliefs[] = {SeenRelief::Generated, SeenRelief::ShapeFromShading, SeenRelief::Photograph,
                                                SeenRelief::Ridge};
std::string nameOf(SeenRelief source);  ///< "generated", "v_shape", "photograph", "ridge"

/// Means over the photographs of one fabric under one light.
struct SurfaceRow {
    protocols::FabricId fabric;
    std::string name, light;
    int photographs = 0;
    bool lampTold = false;                         ///< the generators knew the side of the lamp of every photograph
    std::vector<SurfaceCorrelation> correlations;  ///< in the order of allSeenReliefs; Ridge is 0 without other fabrics
    std::size_t points = 0, unmeasured = 0;        ///< of the surfaces; those without a measured height were left out
    int trainedOn = 0;  ///< photographs of the fabric, under any light, that the model was trained on: it may remember the fabric
    bool hasRidge = true;  ///< other fabrics of the same light taught the regression
};

/// A source of relief over the fabrics of one light.
struct SourceSummary {
    stats::Value mean;
    stats::Interval ci95;         ///< Student's t over fabrics; undefined with one fabric
    stats::Value generatedAbove;  ///< mean over fabrics of the generated relief's correlation minus this one's
    stats::Interval generatedAboveCi95;
    int fabrics = 0, fabricsBelow = 0;  ///< with a correlation; with one below that of the generated relief
};

struct SurfaceReport {
    std::string dataset, model;
    std::vector<SurfaceRow> rows;  ///< by light, then in the order of the fabrics
    std::string memory = {};       ///< a note where training drew the fabrics of this data set; else empty
};

/// One source over `rows`, high-passed at 16 px or at 4 mm. Fabrics without a known scale have no correlation at 4 mm.
SourceSummary summaryOf(const std::vector<const SurfaceRow*>& rows, SeenRelief source, bool isAt4Mm);

/// True where a photograph has its surface.
bool hasSurfaces(const rendering::fabrics::Dataset& dataset);

/// Compares the photographs that have a surface: at most `request.samplesPerFabric` of a fabric and light (4 if not set), evenly
/// spread over its places. Fabrics that the model was trained on stay in, and are marked: their figures also measure memory. The
/// ridge regression learns from all other fabrics under the same light. Photographs tell the generators the side of their lamp
/// (samples.csv, light_deg); those with "two_lamps" to "four_lamps" do not, as if nobody knew it. Points without a
/// measured height are left out. Throws badInput for a surface of another size than its photograph, and for one of which hardly
/// anything was measured.
SurfaceReport evaluateSurfaces(const rendering::fabrics::Dataset& dataset, const EvaluationRequest& request,
                               const Report& report = {}, const Generate& generate = rendering::models::generate);

/// The report as JSON, schema vis2hap.evaluation/1: "surfaces" has the fabrics, "surface_means" the means of each light. Where
/// the model was trained on some of the fabrics, "not_trained_on" has the means over the others.
nlohmann::ordered_json surfacesJson(const SurfaceReport& surfaces);
std::string surfacesText(const SurfaceReport& surfaces);

}  // namespace study::evaluation
