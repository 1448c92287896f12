#include "study/analyse/power/power_report.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "study/analyse/statistic_json.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

ordered_json testJson(const stats::PlannedTest& test)
{
    ordered_json json{{"question", test.question}, {"test", test.test}, {"effect", test.effect}};
    put(json, "detected_with_80_percent", test.smallestDetectable);
    json["detected_is"] = test.detectable;
    json["points"] = ordered_json::array();
    for (const auto& point : test.points) {
        ordered_json row{{"effect", point.effect}};
        put(row, "power", point.power);
        row["power_simulated"] = point.simulated.rate();
        put(row, "simulated_ci95", point.simulated.interval());
        row["undefined"] = point.simulated.undefined;
        put(row, "participants_for_80_percent", point.participants);
        json["points"].push_back(std::move(row));
    }
    return json;
}

const std::map<stats::Promise, const char*> promises{{stats::Promise::Exact, "4.1 to 5.9 %"},
                                                     {stats::Promise::AtMost, "at most 5.9 %"},
                                                     {stats::Promise::Printed, "printed, flagged above 6 %"},
                                                     {stats::Promise::Shown, "the report does not use it for this"}};

ordered_json calibrationJson(const stats::CalibrationRow& row)
{
    ordered_json json{{"test", row.test}, {"truth", row.truth}};
    json["studies"] = row.result.studies;
    json["rejected"] = row.result.rejected;
    json["undefined"] = row.result.undefined;
    json["rate"] = row.result.rate();
    put(json, "ci95", row.result.interval());
    put(json, "attainable_size", row.attainableSize);
    json["promise"] = promises.at(row.promise);
    json["kept"] = row.kept();
    json["anti_conservative"] = row.antiConservative();
    return json;
}

std::string shown(const stats::Value& value, const char* format)
{
    if (!value.exists()) return "-";
    char text[32];
    std::snprintf(text, sizeof text, format, *value);
    return text;
}

/// "paired t; 80 % power at 0.73"
std::string headingOf(const stats::PlannedTest& test)
{
    if (!test.smallestDetectable.exists()) return test.test;
    if (test.detectable == test.effect) return test.test + "; 80 % power at " + shown(test.smallestDetectable, "%.2f");
    return test.test + "; 80 % power needs " + test.detectable + ", of +-" + shown(test.smallestDetectable, "%.2f");
}

}  // namespace

void putDesign(ordered_json& json, const stats::PowerOptions& options)
{
    const auto& design = options.design;
    const auto& truth = options.ratings;
    json["design"] = {{"participants", design.participants},
                      {"fabrics", design.fabrics},
                      {"conditions", design.conditions},
                      {"alternatives", options.hasChoices ? ordered_json(design.alternatives) : ordered_json()},
                      {"equivalence_bounds", {options.equivalenceBounds.first, options.equivalenceBounds.second}}};
    if (!options.hasChoices) json["design"]["why"] = {{"alternatives", "no answer is right or wrong"}};
    json["assumed"] = {{"variance_participant", truth.participant},
                       {"variance_fabric", truth.fabric},
                       {"variance_participant_condition", truth.participantCondition},
                       {"variance_fabric_condition", truth.fabricCondition},
                       {"variance_residual", truth.residual},
                       {"sd_of_participant_differences", truth.sdOfDifference(design)},
                       {"sd_participant_log_odds", options.choices.participantSd},
                       {"sd_fabric_log_odds", options.choices.fabricSd}};
    json["simulation"] = {{"studies", options.simulation.studies}, {"seed", options.simulation.seed}};
}

void putTests(ordered_json& json, const std::vector<stats::PlannedTest>& tests)
{
    json["tests"] = ordered_json::array();
    for (const auto& test : tests) json["tests"].push_back(testJson(test));
}

void putCalibration(ordered_json& json, const std::vector<stats::CalibrationRow>& rows)
{
    json["calibration"] = ordered_json::array();
    for (const auto& row : rows) json["calibration"].push_back(calibrationJson(row));
}

void printDesign(const std::string& protocol, const stats::PowerOptions& options)
{
    const auto& design = options.design;
    const auto& truth = options.ratings;
    std::printf("%s: %zu participants x %zu fabrics x %zu conditions\n", protocol.c_str(), design.participants, design.fabrics,
                design.conditions);
    if (options.hasRatings)
        std::printf(
            "assumed variances of ratings: participants %.3g, fabrics %.3g, participant x condition %.3g,\n"
            "  fabric x condition %.3g, residual %.3g; a participant's difference between two conditions has SD %.2f\n",
            truth.participant, truth.fabric, truth.participantCondition, truth.fabricCondition, truth.residual,
            truth.sdOfDifference(design));
    if (options.hasChoices)
        std::printf("assumed log odds of choices among %d: SD %.2g between participants and %.2g between fabrics\n",
                    design.alternatives, options.choices.participantSd, options.choices.fabricSd);
    std::printf(
        "The results depend on these assumptions. Each row uses %zu simulated studies: rates are within +-%.1f percentage "
        "points.\n",
        options.simulation.studies, 196 * std::sqrt(0.25 / static_cast<double>(options.simulation.studies)));
}

void printTests(const std::vector<stats::PlannedTest>& tests)
{
    if (tests.empty()) std::printf("this design has no conditions to compare\n");
    std::string effect;
    for (const auto& test : tests) {
        if (test.effect != effect) std::printf("\n%s: %s\n", test.question.c_str(), (effect = test.effect).c_str());
        std::printf("  %s\n    %8s %8s %10s %20s\n", headingOf(test).c_str(), "effect", "formula", "simulated",
                    "participants (80 %)");
        for (const auto& point : test.points)
            std::printf("    %8.3g %8s %10.3f %20s\n", point.effect, shown(point.power, "%.3f").c_str(), point.simulated.rate(),
                        shown(point.participants, "%.0f").c_str());
    }
}

void printCalibration(const std::vector<stats::CalibrationRow>& rows)
{
    std::printf("\nrejections at alpha 5 %% in studies without a difference\n");
    std::string truth;
    for (const auto& row : rows) {
        if (row.truth != truth) std::printf("%s\n", (truth = row.truth).c_str());
        const auto& result = row.result;
        const auto interval = result.interval();
        const std::string size =
            row.attainableSize.exists() ? ", attainable " + shown(100 * *row.attainableSize, "%.2f") + " %" : "";
        std::printf("  %-58s %6zu of %6zu  %5.2f %% [%.2f, %.2f]%s %s%s\n", row.test.c_str(), result.rejected, result.studies,
                    100 * result.rate(), 100 * *interval.low, 100 * *interval.high, size.c_str(), row.verdict().c_str(),
                    row.promise == stats::Promise::Shown ? " (the report does not use it for this)" : "");
    }
}

}  // namespace study::analyse
