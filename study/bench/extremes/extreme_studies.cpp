#include "study/bench/extremes/extreme_studies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <set>

#include "database/study_store.h"
#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol_json.h"
#include "rendering/models/generation.h"
#include "reports/analysis/study_analysis.h"
#include "study/bench/bench_study.h"

namespace study::bench {

namespace {

using Cases = std::vector<ExtremeCase>;

ExtremeCase studyCase(const std::string& room, const std::string& input, const std::string& asked, const std::string& truth,
                      const std::string& source, std::function<double()> ours)
{
    return {room,
            input,
            asked,
            truth,
            source,
            truth == "refused" ? 0.0 : 16.0,
            [ours = std::move(ours)] { return answerOrFault(ours); },
            {}};
}

/// Heights, magnitudes and trace of a photograph that are not finite, and heights below 0.
double faultyNumbers(const cv::Mat& photograph)
{
    const std::vector<rendering::models::InputPhotograph> photographs{{photograph, 0.05}};
    rendering::models::GenerationOptions options;
    options.quality = rendering::models::Quality::Fast;
    const auto signals = rendering::models::generate(photographs, options).front();
    double faulty = 0;
    for (const cv::Mat& map : {signals.heightMm, signals.spectrogram})
        for (int i = 0; i < map.rows; ++i)
            for (int j = 0; j < map.cols; ++j) {
                const float value = map.at<float>(i, j);
                faulty += std::isfinite(value) && value >= 0 ? 0 : 1;
            }
    for (const double value : signals.trace) faulty += std::isfinite(value) ? 0 : 1;
    return faulty + (std::isfinite(signals.meanFriction) && signals.meanFriction > 0 ? 0 : 1);
}

void addGenerators(Cases& cases)
{
    struct Extreme {
        const char* name;
        cv::Size size;
        int level;
    };
    for (const Extreme& one : {Extreme{"a photograph of 1 pixel", {1, 1}, 90}, Extreme{"a black photograph", {128, 128}, 0},
                               Extreme{"a white photograph", {128, 128}, 255}, Extreme{"a strip of 400 x 3", {400, 3}, 130}})
        cases.push_back(studyCase("generators", one.name, "faulty numbers of relief, friction and trace", "0",
                                  "heights, magnitudes and friction are finite and not negative", [=] {
                                      cv::Mat photograph(one.size, CV_8UC3, cv::Scalar::all(one.level));
                                      if (one.level == 130) cv::RNG(5).fill(photograph, cv::RNG::UNIFORM, 0, 256);
                                      return faultyNumbers(photograph);
                                  }));
    cases.push_back(studyCase("generators", "a photograph without pixels", "faulty numbers of relief, friction and trace",
                              "refused", "nothing to see", [] { return faultyNumbers(cv::Mat()); }));
}

protocols::Protocol smallProtocol(int participants, int fabrics, int conditions)
{
    protocols::Protocol protocol;
    protocol.participants = participants;
    protocol.fabricCount = fabrics;
    for (int c = 1; c <= conditions; ++c) protocol.conditions.emplace_back("c" + std::to_string(c));
    const protocols::Question rating{protocols::QuestionId("Q1"), "", protocols::Rating{}};
    protocol.phases.push_back({{rating}, rating.kind});
    return protocol;
}

/// Cells of participant x fabric x condition that are not presented exactly once.
double wrongCells(const protocols::Protocol& protocol)
{
    double wrong = 0;
    for (const auto& trials : protocols::drawDesign(protocol, 1).participants) {
        std::map<std::pair<int, int>, int> times;
        for (const auto& trial : trials) ++times[{trial.fabric, trial.label}];
        for (int f = 0; f < protocol.fabricCount; ++f)
            for (int c = 0; c < static_cast<int>(protocol.conditions.size()); ++c) wrong += times[{f, c}] == 1 ? 0 : 1;
    }
    return wrong;
}

/// Largest less smallest number of times that one condition follows another.
double imbalance(const protocols::Protocol& protocol)
{
    const auto count = protocol.conditions.size();
    std::vector<int> follows(count * count);
    for (const auto& trials : protocols::drawDesign(protocol, 1).participants)
        for (std::size_t i = 1; i < trials.size(); ++i)
            ++follows[static_cast<std::size_t>(trials[i - 1].label) * count + static_cast<std::size_t>(trials[i].label)];
    int least = follows[1], most = follows[1];
    for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b)
            if (a != b) {
                least = std::min(least, follows[a * count + b]);
                most = std::max(most, follows[a * count + b]);
            }
    return most - least;
}

void addOrders(Cases& cases)
{
    struct Extreme {
        int participants, fabrics, conditions;
    };
    for (const Extreme& one : {Extreme{1, 1, 2}, Extreme{1, 7, 2}, Extreme{10, 7, 40}, Extreme{1, 1, 40}, Extreme{300, 2, 2}}) {
        const std::string input = std::to_string(one.participants) + " participants x " + std::to_string(one.fabrics) +
                                  " fabrics x " + std::to_string(one.conditions) + " conditions";
        const auto protocol = smallProtocol(one.participants, one.fabrics, one.conditions);
        cases.push_back(studyCase("orders", input, "cells not presented exactly once", "0", "every cell is presented once",
                                  [=] { return wrongCells(protocol); }));
    }
    cases.push_back(studyCase("orders", "10 participants x 7 fabrics x 9 conditions",
                              "most less fewest successions of conditions", "1", "620 successions over 72 pairs cannot be equal",
                              [] { return imbalance(smallProtocol(10, 7, 9)); }));
}

double ofEmptyStudy(const std::function<double(const database::StudyStore&)>& asked)
{
    const protocols::TemporaryFolder place;
    const auto folder = makeConstantStudy(place.path() / "study", std::string(protocols::paperProtocolJson()));
    return asked(database::StudyStore(folder, database::StudyStore::Access::Read));
}

void addStore(Cases& cases)
{
    const std::string empty = "a study without answers";
    cases.push_back(studyCase("store", empty, "answers read", "0", "nothing was stored", [] {
        return ofEmptyStudy([](const auto& store) { return static_cast<double>(store.answers().size()); });
    }));
    cases.push_back(studyCase("store", empty, "faults of the hash chain", "0", "nothing was altered", [] {
        return ofEmptyStudy([](const auto& store) { return static_cast<double>(store.faults().size()); });
    }));
    cases.push_back(studyCase("store", "an id of no letters", "slot", "refused", "a participant needs a name", [] {
        const protocols::TemporaryFolder place;
        const auto folder = makeConstantStudy(place.path() / "study", std::string(protocols::paperProtocolJson()));
        database::StudyStore store(folder, database::StudyStore::Access::Write);
        return static_cast<double>(store.enrol(protocols::ParticipantId(""), database::ParticipantKind::Simulated).number);
    }));
    cases.push_back(studyCase("store", "a report of no answers", "answers analysed", "0", "there are none", [] {
        reports::StudyData data;
        data.blinded = false;
        data.conditions = {"a", "b"};
        data.fabrics = {"F01"};
        data.questions = {{"Q1", "", protocols::Rating{}}};
        return static_cast<double>(reports::analyse(data).completeness.present);
    }));
}

}  // namespace

Cases extremeStudies()
{
    Cases cases;
    for (const auto add : {addGenerators, addOrders, addStore}) add(cases);
    return cases;
}

}  // namespace study::bench
