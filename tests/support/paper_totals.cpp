#include "tests/support/paper_totals.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace support {

namespace {

constexpr int participants = 10;

/// The k-th of 70 ratings whose mean is `mean`, rounded to tenths. Deviations come in pairs that cancel.
double rating(double mean, int k)
{
    const int spread = k / 2 % 13;
    return (std::lround(mean * 10) + (k % 2 ? -spread : spread)) / 10.0;
}

}  // namespace

const std::vector<PaperTotal>& paperTotals()
{
    // Published: v_grey 3.9 matches, ratings 5.1, 5.4, 5.4; f_g 5.6 matches; h_g&f_g ratings 6.3, 6.8, 6.6; h&f 7.1 matches,
    // ratings 6.6, 7.0, 6.9. Chosen from the text: v_shape is a little above v_grey in texture and realism ("around 5.5").
    // f_g is above v_shape by 0.9 (slipperiness) and 0.4 (realism). h_g is above f_g by 0.2 (texture) and 0.1 (realism).
    // t_grey is the lowest of the measured conditions; f and h are above f_g and h_g.
    static const std::vector<PaperTotal> totals{
        {"v_grey", 27, {5.1, 5.4, 5.4}, true, true},   {"v_shape", 28, {5.0, 5.6, 5.5}, false, false},
        {"f_g", 39, {5.9, 6.2, 5.9}, true, false},     {"h_g", 41, {5.8, 6.4, 6.0}, false, false},
        {"h_g&f_g", 46, {6.3, 6.8, 6.6}, false, true}, {"t_grey", 30, {5.2, 5.5, 5.3}, false, false},
        {"f", 43, {6.4, 6.3, 6.2}, false, false},      {"h", 46, {6.1, 6.8, 6.5}, false, false},
        {"h&f", 50, {6.6, 7.0, 6.9}, true, true},
    };
    return totals;
}

std::vector<nlohmann::ordered_json> paperScripts(const std::vector<std::string>& fabrics)
{
    std::vector<nlohmann::ordered_json> scripts;
    for (int p = 0; p < participants; ++p) {
        nlohmann::ordered_json script{{"schema", "vis2hap.script/1"},
                                      {"participant", (p < 9 ? "S0" : "S") + std::to_string(p + 1)},
                                      {"answers", nlohmann::ordered_json::array()}};
        for (const auto& total : paperTotals())
            for (std::size_t f = 0; f < fabrics.size(); ++f) {
                const int k = p * static_cast<int>(fabrics.size()) + static_cast<int>(f);
                const auto answer = [&](const char* question, const nlohmann::ordered_json& value, double seconds) {
                    script["answers"].push_back({{"question", question},
                                                 {"condition", total.condition},
                                                 {"fabric", fabrics[f]},
                                                 {"answer", value},
                                                 {"seconds", seconds}});
                };
                // Spreads the correct answers evenly over the 70 pairs of participant and fabric.
                const bool correct = (k + 1) * total.correct / 70 > k * total.correct / 70;
                answer("Q1", correct ? "correct" : k % 2 ? "foil:1" : "foil:2", 7.5 + k % 5);
                for (int q = 0; q < 3; ++q) answer(q == 0 ? "Q2" : q == 1 ? "Q3" : "Q4", rating(total.ratings[q], k), 3 + k % 3);
            }
        scripts.push_back(script);
    }
    return scripts;
}

}  // namespace support
