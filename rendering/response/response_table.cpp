#include "rendering/response/response_table.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"

namespace rendering {

namespace {

constexpr double mostCoefficient = 10;

struct Meaning {
    const char* name;
    std::vector<std::string> usual;  ///< in lower case
};

const std::vector<Meaning>& meanings()
{
    static const std::vector<Meaning> table{
        {"level", {"level", "grey_level", "gray_level", "grey level", "gray level", "grey", "gray", "greylevel", "graylevel"}},
        {"friction", {"mu", "friction", "friction_coefficient", "friction coefficient", "coefficient", "cof"}},
        {"force", {"tangential_n", "friction_n", "friction_force_n", "force_n", "ft_n", "tangential"}},
        {"load", {"load_n", "normal_n", "normal_force_n", "fn_n", "load", "normal"}},
        {"sweep", {"sweep", "run", "repeat"}},
    };
    return table;
}

std::string lowered(std::string text)
{
    for (char& letter : text)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return text;
}

std::optional<std::size_t> columnFor(const protocols::CsvTable& table, const Meaning& meaning,
                                     const std::map<std::string, std::string>& given)
{
    if (const auto named = given.find(meaning.name); named != given.end()) {
        const auto column = table.column(named->second);
        if (!column)
            throw protocols::badInput({"the table has no column \"" + named->second + "\"", table.where,
                                       "the column that --map names for " + named->first, "correct --map"});
        return column;
    }
    for (const auto& usual : meaning.usual)
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            if (lowered(table.columns[i]) == usual) return i;
    return std::nullopt;
}

struct ResponseColumns {
    std::optional<std::size_t> level, friction, force, load, sweep;
};

ResponseColumns responseColumns(const protocols::CsvTable& table, const std::map<std::string, std::string>& given)
{
    for (const auto& [name, column] : given)
        if (std::none_of(meanings().begin(), meanings().end(), [&](const Meaning& one) { return name == one.name; }))
            throw protocols::badInput({"\"" + name + "\" is no meaning of a column", "--map",
                                       "level, friction, force, load or sweep", "write --map level=COLUMN"});
    const auto find = [&](std::size_t i) { return columnFor(table, meanings()[i], given); };
    ResponseColumns found{find(0), find(1), find(2), find(3), find(4)};
    if (!found.level)
        throw protocols::badInput(
            {"the table has no column of grey levels", table.where, "a column \"level\"", "name yours: --map level=COLUMN"});
    if (!found.friction && !found.force)
        throw protocols::badInput({"the table has no column of friction", table.where,
                                   "a column \"mu\" (coefficient) or \"friction_n\" (force)",
                                   "name yours: --map friction=COLUMN or --map force=COLUMN"});
    return found;
}

protocols::Error faultInCell(const protocols::CsvTable& table, std::size_t row, std::size_t column, const std::string& expected)
{
    return protocols::badInput({"the value is " + table.rows[row][column],
                                rowName(table, row) + ", column " + table.columns[column], expected, "correct the table"});
}

int levelAt(const protocols::CsvTable& table, std::size_t row, std::size_t column)
{
    const double level = numberAt(table, row, column);
    if (level != std::floor(level) || level < 0 || level > 255)
        throw faultInCell(table, row, column, "a grey level: a whole number from 0 to 255");
    return static_cast<int>(level);
}

/// Load of a row, from its column or as stated.
double loadAt(const protocols::CsvTable& table, std::size_t row, const ResponseColumns& columns, double stated)
{
    if (!columns.load) return stated;
    const double load = numberAt(table, row, *columns.load);
    if (!(load > 0 && load <= 1000)) throw faultInCell(table, row, *columns.load, "a load above 0 N");
    return load;
}

double frictionAt(const protocols::CsvTable& table, std::size_t row, const ResponseColumns& columns, double load)
{
    const std::size_t column = columns.friction.value_or(columns.force.value_or(0));
    const double value = numberAt(table, row, column);
    if (value < 0) throw faultInCell(table, row, column, "friction that is not negative");
    const double friction = columns.friction ? value : value / load;
    if (friction > mostCoefficient)
        throw faultInCell(table, row, column,
                          columns.friction ? "a friction coefficient of at most 10; a force needs --map force=COLUMN"
                                           : "a force in newtons, at most 10 times the load");
    return friction;
}

void requireOneLoad(const ResponseColumns& columns, std::optional<double> loadN, const std::string& where)
{
    if (!columns.load && !loadN)
        throw protocols::badInput({"the load of the finger is not stated", where, "a column \"load_n\", or --load N",
                                   "state it: friction of a display depends on it"});
    if (columns.load && loadN)
        throw protocols::badInput({"the load is stated twice", where, "the column of the table, or --load", "leave --load out"});
}

}  // namespace

ResponseTable readResponseTable(const std::filesystem::path& file, const std::map<std::string, std::string>& columns,
                                std::optional<double> loadN)
{
    const auto foreign = protocols::readForeignTable(file);
    const protocols::CsvTable& table = foreign.table;
    const ResponseColumns found = responseColumns(table, columns);
    requireOneLoad(found, loadN, table.where);
    ResponseTable result;
    if (!foreign.isUsual) result.taken = foreign.taken;
    std::vector<double> loads;
    std::vector<bool> begins;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double load = loadAt(table, row, found, loadN.value_or(0));
        loads.push_back(load);
        result.measurements.push_back({levelAt(table, row, *found.level), frictionAt(table, row, found, load)});
        begins.push_back(row == 0 || (found.sweep && table.rows[row][*found.sweep] != table.rows[row - 1][*found.sweep]));
    }
    addDirections(result.measurements, begins);
    if (!loads.empty()) {
        std::nth_element(loads.begin(), loads.begin() + static_cast<std::ptrdiff_t>(loads.size() / 2), loads.end());
        result.loadN = loads[loads.size() / 2];
    }
    return result;
}

}  // namespace rendering
