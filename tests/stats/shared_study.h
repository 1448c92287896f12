// Reads the shared simulated studies and R's analyses of them. Not a test by itself.
#pragma once

#include <QByteArray>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "stats/models/crossed_study.h"
#include "tests/stats/oracle_cases.h"

namespace shared {

using Rows = std::vector<std::vector<std::string>>;

/// All rows of a CSV file without quotes, the header first; none where the file is absent.
inline Rows readCsv(const std::filesystem::path& file)
{
    std::ifstream in(file);
    Rows rows;
    for (std::string line; std::getline(in, line);) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        std::vector<std::string> cells(1);
        for (const char c : line)
            if (c == ',')
                cells.emplace_back();
            else
                cells.back() += c;
        rows.push_back(std::move(cells));
    }
    return rows;
}

inline std::vector<std::string> column(const Rows& rows, std::size_t index)
{
    std::vector<std::string> result;
    for (std::size_t i = 1; i < rows.size(); ++i) result.push_back(rows[i][index]);
    return result;
}

inline std::vector<double> numbers(const Rows& rows, std::size_t index)
{
    std::vector<double> result;
    for (const std::string& cell : column(rows, index)) {
        std::istringstream text(cell);
        text.imbue(std::locale::classic());
        double value = NAN;
        if (!(text >> value)) value = NAN;  // an empty cell is missing
        result.push_back(value);
    }
    return result;
}

inline std::filesystem::path studyFolder() { return oracle::sharedFolder() / "oracle/study/public"; }

/// Columns: participant, fabric, condition, Q1_correct, Q2, Q3, Q4.
inline stats::CrossedStudy study(const Rows& rows, std::size_t answers)
{
    return {stats::factorOf("participant", column(rows, 0)), stats::factorOf("fabric", column(rows, 1)),
            stats::factorOf("condition", column(rows, 2)), numbers(rows, answers)};
}

inline nlohmann::json expected(const std::string& name)
{
    return nlohmann::json::parse(std::ifstream(studyFolder() / (name + "_expected.json")));
}

}  // namespace shared
