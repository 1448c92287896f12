#include "study/bench/bench_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <opencv2/core.hpp>

#include "rendering/composition/friction_image.h"
#include "rendering/display/stroke.h"
#include "stats/power/simulated_study.h"
#include "stats/tests/friedman_exact.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/sign_flip.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/wilcoxon.h"
#include "study/bench/bench_turns.h"

namespace study::bench {

namespace {

using Rows = std::vector<BenchRow>;

void append(Rows& rows, Rows more) { rows.insert(rows.end(), more.begin(), more.end()); }

constexpr std::size_t studies = 20;

/// Ratings of twelve participants under four conditions, tied here and there.
std::vector<stats::BlockTable> ratingTables()
{
    std::vector<stats::BlockTable> tables;
    for (std::size_t k = 0; k < studies; ++k) {
        stats::Draws draws(5, k);
        stats::BlockTable table{12, 4, {}};
        for (std::size_t i = 0; i < 48; ++i)
            table.values.push_back(std::round(10 + 2 * draws.normal() + 0.6 * static_cast<double>(i % 4)) / 2);
        tables.push_back(table);
    }
    return tables;
}

double meanDistance(const std::vector<double>& found, const std::vector<double>& truth)
{
    double sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) sum += std::fabs(found[i] - truth[i]);
    return sum / static_cast<double>(truth.size());
}

/// Settings that each give a p for every table; the last one is exact.
Rows testsOf(const std::string& stage, const std::string& note,
             const std::vector<std::pair<std::string, double (*)(const stats::BlockTable&)>>& tests)
{
    const auto tables = ratingTables();
    std::vector<double> truth, found(tables.size());
    for (const auto& table : tables) truth.push_back(tests.back().second(table));
    std::vector<TimedSetting> settings;
    for (const auto& [name, p] : tests)
        settings.push_back({{stage, name, {}, {}, "mean |p - exact p|", note},
                            [&tables, &found, p] { std::transform(tables.begin(), tables.end(), found.begin(), p); },
                            [&] { return meanDistance(found, truth); }});
    return benchInTurns(settings);
}

std::vector<double> differencesOf(const stats::BlockTable& table)
{
    std::vector<double> differences = table.column(3);
    for (std::size_t i = 0; i < table.blocks; ++i) differences[i] -= table.at(i, 0);
    return differences;
}

Rows exactTests()
{
    Rows rows = testsOf("Friedman, 12 blocks x 4", "20 tables of tied ratings",
                        {{"chi-squared", [](const stats::BlockTable& t) { return *stats::friedmanTest(t).p; }},
                         {"F", [](const stats::BlockTable& t) { return *stats::friedmanTest(t).fP; }},
                         {"exact", [](const stats::BlockTable& t) { return *stats::exactFriedman(t).p; }}});
    append(rows, testsOf("sign flips of 12 differences", "20 samples; the normal curve of the t test against all 4096 signs",
                         {{"t test", [](const stats::BlockTable& t) { return *stats::oneSampleTTest(differencesOf(t)).p; }},
                          {"exact", [](const stats::BlockTable& t) { return *stats::signFlipTest(differencesOf(t), {}).p; }}}));
    return rows;
}

/// A planted study of the paper's size, and the standard error of a difference of two conditions for new participants and
/// new fabrics, which its variances fix.
struct PlantedStudies {
    stats::StudyDesign design;
    stats::RatingTruth truth;
    std::vector<stats::CrossedStudy> ratings, choices;
    std::vector<double> means = std::vector<double>(9), logOdds{-0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2};

    PlantedStudies()
    {
        for (std::size_t c = 0; c < means.size(); ++c) means[c] = 0.2 * static_cast<double>(c);
        truth.fabricCondition = 0.2;
        for (std::size_t k = 0; k < 8; ++k) {
            stats::Draws draws(9, k);
            ratings.push_back(stats::emptyStudy(design));
            stats::drawRatings(ratings.back(), truth, means, draws);
            choices.push_back(stats::emptyStudy(design));
            stats::drawChoices(choices.back(), {}, logOdds, draws);
        }
    }

    double trueError() const
    {
        const auto n = static_cast<double>(design.participants), m = static_cast<double>(design.fabrics);
        return std::sqrt(2 * (truth.participantCondition / n + truth.fabricCondition / m + truth.residual / (n * m)));
    }
};

double errorByParticipants(const stats::CrossedStudy& study)
{
    const auto means = stats::participantMeans(study);
    return *stats::pairedTTest(means.column(1), means.column(0)).se;
}

double errorByModel(const stats::CrossedStudy& study) { return *stats::fitRatings(study).model.fixed.at(1).test.se; }

Rows mixedModels()
{
    const auto planted = std::make_shared<PlantedStudies>();
    const auto found = std::make_shared<std::vector<double>>(planted->ratings.size());
    const auto setting = [&](const char* name, double (*error)(const stats::CrossedStudy&), const char* note) {
        return TimedSetting{{"standard error, 10 x 7 x 9 ratings", name, {}, {}, "% of the planted one", note},
                            [=] { std::transform(planted->ratings.begin(), planted->ratings.end(), found->begin(), error); },
                            [=] {
                                double sum = 0;
                                for (const double one : *found) sum += one / static_cast<double>(found->size());
                                return 100 * std::fabs(sum / planted->trueError() - 1);
                            }};
    };
    return benchInTurns({setting("paired t", errorByParticipants, "8 studies; participants only, as if no other fabric existed"),
                         setting("mixed model", errorByModel, "8 studies; four random terms, for new participants and fabrics")});
}

Rows choiceModels()
{
    const auto planted = std::make_shared<PlantedStudies>();
    const auto found = std::make_shared<std::vector<double>>();
    const auto setting = [&](const char* name, stats::ChoiceTerms terms) {
        return TimedSetting{{"log odds, 10 x 7 x 9 choices", name, {}, {}, "mean |log odds - planted|", "8 studies"},
                            [=] {
                                found->clear();
                                for (const auto& study : planted->choices) {
                                    const auto fitted = stats::fitChoices(study, terms);
                                    for (std::size_t c = 1; c < fitted.model.fixed.size(); ++c)
                                        found->push_back(fitted.model.fixed[c].estimate.orElse(0));
                                }
                            },
                            [=] {
                                double sum = 0;
                                for (std::size_t i = 0; i < found->size(); ++i)
                                    sum += std::fabs((*found)[i] - (planted->logOdds[1 + i % 8] - planted->logOdds[0]));
                                return sum / static_cast<double>(found->size());
                            }};
    };
    return benchInTurns({setting("main effects", stats::ChoiceTerms::MainEffects),
                         setting("interactions", stats::ChoiceTerms::WithInteractions)});
}

}  // namespace

std::vector<BenchRow> benchModels()
{
    Rows rows = exactTests();
    append(rows, mixedModels());
    append(rows, choiceModels());
    return rows;
}

std::vector<BenchRow> benchPerception()
{
    // A sine of the friction along x: contact and skin weaken it by known factors (rendering/display/stroke.h), and delay it.
    constexpr double periodMm = 1.7, full = 65535, depth = 0.8;
    rendering::StrokeOptions base;
    const double k = 2 * std::numbers::pi / periodMm, omega = k * base.speedMmPerS, sigma = base.contactMm / 2;
    cv::Mat image(1, rendering::displayWidthPx, CV_16UC1);
    for (int j = 0; j < image.cols; ++j)
        image.at<std::uint16_t>(0, j) =
            cv::saturate_cast<std::uint16_t>(full * (0.5 + depth / 2 * std::sin(k * j * base.mmPerPixel)));
    const std::complex<double> gain = std::exp(-0.5 * k * k * sigma * sigma) / std::complex<double>(1, omega * base.responseS);
    const double rise = base.highestFriction - base.glassFriction;
    const auto truthAt = [&](double mm) {
        const double swing = (gain * std::exp(std::complex<double>(0, k * mm))).imag();
        return base.normalForceN * (base.glassFriction + rise * (0.5 + depth / 2 * swing));
    };
    std::vector<rendering::StrokeSample> samples;
    std::vector<TimedSetting> settings;
    for (const double rate : {250.0, 500.0, 1000.0, 2000.0, 4000.0})
        settings.push_back({{"simulated finger on a sine",
                             std::to_string(static_cast<int>(rate)) + " Hz",
                             {},
                             {},
                             "% of the swing",
                             "force against its closed form; simulate uses 1000 Hz"},
                            [&, rate] {
                                auto options = base;
                                options.sampleRateHz = rate;
                                samples = rendering::strokeImage(image, 0, false, options);
                            },
                            [&] {
                                double squares = 0, count = 0;
                                for (const auto& sample : samples)
                                    if (sample.positionMm > 10 && sample.positionMm < 200) {
                                        squares += std::pow(sample.tangentialN - truthAt(sample.positionMm), 2);
                                        ++count;
                                    }
                                const double swing = base.normalForceN * rise * depth / 2 * std::abs(gain) / std::sqrt(2.0);
                                return 100 * std::sqrt(squares / count) / swing;
                            }});
    return benchInTurns(settings);
}

}  // namespace study::bench
