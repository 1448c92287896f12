// Small studies for the tests of the report.
#pragma once

#include <QByteArray>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/data/study_data.h"

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

/// A complete study of the given size with Q1 and Q2 to Q4, unblinded, without times.
inline reports::StudyData study(int participants, int fabrics, const std::vector<std::string>& conditions, const Answers& answers)
{
    reports::StudyData data;
    data.name = "Built study";
    data.protocolSha256 = "00";
    data.blinded = false;
    data.conditions = conditions;
    data.questions = {{"Q1", "Which?", true}, {"Q2", "", false}, {"Q3", "", false}, {"Q4", "", false}};
    for (int p = 0; p < participants; ++p) data.participants.push_back(numbered("P", p + 1));
    for (int f = 0; f < fabrics; ++f) data.fabrics.push_back(numbered("F", f + 1));
    for (int p = 0; p < participants; ++p)
        for (int f = 0; f < fabrics; ++f)
            for (int c = 0; c < static_cast<int>(conditions.size()); ++c) {
                reports::Response response;
                response.participant = numbered("P", p + 1);
                response.fabric = numbered("F", f + 1);
                response.condition = conditions[static_cast<std::size_t>(c)];
                response.question = "Q1";
                response.correct = answers.isCorrect(p, f, c);
                data.responses.push_back(response);
                response.correct.reset();
                for (int q = 2; q <= 4; ++q) {
                    response.question = "Q" + std::to_string(q);
                    response.rating = answers.rating(p, f, c, q);
                    data.responses.push_back(response);
                }
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
