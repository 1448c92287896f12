// Small studies for the tests of the report.
#pragma once

#include <QByteArray>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"

namespace builders {

inline std::filesystem::path sharedFolder()
{
    const QByteArray named = qgetenv("VIS2HAP_SHARED");
    if (!named.isEmpty()) return named.toStdString();
    return std::filesystem::path(VIS2HAP_SOURCE_DIR) / ".." / "shared";
}

inline std::string numbered(const std::string& letter, int n) { return letter + (n < 10 ? "0" : "") + std::to_string(n); }

/// Which answer a participant gives; participants, fabrics and conditions count from 0.
struct Answers {
    std::function<bool(int participant, int fabric, int condition)> isCorrect;
    std::function<double(int participant, int fabric, int condition, int question)> rating;
};

inline const protocols::AnswerKind amongThree = protocols::ForcedChoice{};
inline const protocols::AnswerKind onScale = protocols::Rating{};

inline reports::StudyResponse right(const std::string& participant, const std::string& fabric, const std::string& condition,
                                    const std::string& question, bool isRight)
{
    return {participant, fabric, condition, question, reports::ChosenAnswer{isRight, {}, {}}, {}};
}

inline reports::StudyResponse rated(const std::string& participant, const std::string& fabric, const std::string& condition,
                                    const std::string& question, double rating)
{
    return {participant, fabric, condition, question, reports::RatedAnswer{rating}, {}};
}

inline reports::StudyResponse worded(const std::string& participant, const std::string& fabric, const std::string& condition,
                                     const std::string& question, const std::string& words)
{
    return {participant, fabric, condition, question, reports::WordedAnswer{words}, {}};
}

/// An unblinded study without answers: participants P01, P02 ..., who have finished; fabrics F01, F02 ...
inline reports::StudyData emptyStudy(int participants, int fabrics, const std::vector<std::string>& conditions,
                                     const std::vector<reports::QuestionInfo>& questions)
{
    reports::StudyData data;
    data.name = "Built study";
    data.protocolSha256 = "00";
    data.blinded = false;
    data.conditions = conditions;
    data.questions = questions;
    for (int p = 0; p < participants; ++p) data.participants.push_back(numbered("P", p + 1));
    data.finished.insert(data.participants.begin(), data.participants.end());
    for (int f = 0; f < fabrics; ++f) data.fabrics.push_back(numbered("F", f + 1));
    return data;
}

/// A complete study of the given size with Q1 and Q2 to Q4, unblinded, without times.
inline reports::StudyData study(int participants, int fabrics, const std::vector<std::string>& conditions, const Answers& answers)
{
    reports::StudyData data =
        emptyStudy(participants, fabrics, conditions,
                   {{"Q1", "Which?", amongThree}, {"Q2", "", onScale}, {"Q3", "", onScale}, {"Q4", "", onScale}});
    for (int p = 0; p < participants; ++p)
        for (int f = 0; f < fabrics; ++f)
            for (int c = 0; c < static_cast<int>(conditions.size()); ++c) {
                const std::string &participant = data.participants[static_cast<std::size_t>(p)],
                                  &fabric = data.fabrics[static_cast<std::size_t>(f)],
                                  &condition = conditions[static_cast<std::size_t>(c)];
                data.responses.push_back(right(participant, fabric, condition, "Q1", answers.isCorrect(p, f, c)));
                for (int q = 2; q <= 4; ++q)
                    data.responses.push_back(
                        rated(participant, fabric, condition, "Q" + std::to_string(q), answers.rating(p, f, c, q)));
            }
    return data;
}

inline const std::vector<std::string> nineConditions{"v_grey", "v_shape", "f_g", "h_g", "h_g&f_g", "t_grey", "f", "h", "h&f"};

/// A study of the paper's size whose answers vary; matches of condition c: 27 + 3 c of 70.
inline reports::StudyData paperSized()
{
    return study(10, 7, nineConditions,
                 {[](int p, int f, int c) { return (p * 7 + f) * 37 % 70 < 27 + 3 * c; },
                  [](int p, int f, int c, int q) { return (40 + 2 * c + (p * 13 + f * 29 + c * 17 + q * 7) % 31) / 10.0; }});
}

}  // namespace builders
