// vis2hap describe, compare and metrics: single numbers for scripts and quick checks.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "study/analyse/column_statistics.h"
#include "study/analyse/csv_column.h"
#include "study/analyse/similarity.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/number_checks.h"
#include "study/commands/parts/pair_options.h"
#include "study/looking/open_study.h"

namespace study::commands {

namespace {

using analyse::ColumnTest;
using nlohmann::ordered_json;

const std::map<std::string, ColumnTest> columnTests{{"paired", ColumnTest::Paired},
                                                    {"welch", ColumnTest::Welch},
                                                    {"student", ColumnTest::Student},
                                                    {"tost", ColumnTest::Equivalence},
                                                    {"wilcoxon", ColumnTest::Wilcoxon}};
const std::map<std::string, stats::Tail> tails{
    {"two-sided", stats::Tail::TwoSided}, {"less", stats::Tail::Less}, {"greater", stats::Tail::Greater}};

/// Prints the object as lines of text. Nested objects are only in the JSON.
void output(const JsonTarget& target, const ordered_json& json)
{
    if (target) return writeJson(target, json);
    for (const auto& [field, value] : json.items())
        if (field != "schema" && field != "why" && !value.is_object())
            std::printf("%-22s %s\n", field.c_str(), value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
    if (json.contains("effect"))
        std::printf("%-22s %s\n", json["effect"]["name"].get<std::string>().c_str(), json["effect"]["value"].dump().c_str());
    if (json.contains("why"))
        for (const auto& [field, reason] : json["why"].items()) {
            const bool existsInPart = json.contains(field) && json[field].is_array();
            std::printf("%s%s: %s\n", field.c_str(), existsInPart ? "" : " does not exist", reason.get<std::string>().c_str());
        }
}

/// Standard output is for the numbers.
void noteOnForm(const std::string& sentence) { std::fprintf(stderr, "%s\n", protocols::printable(sentence).c_str()); }

struct DescribeCall {
    std::string csv, column;
    JsonTarget target;
};

int describe(const DescribeCall& call)
{
    output(call.target, analyse::describeColumn(analyse::readColumn(call.csv, call.column, noteOnForm)));
    return 0;
}

struct CompareCall {
    std::string csv, a, b, test = "paired", bounds = "-0.5,0.5", alternative = "two-sided";
    JsonTarget target;
};

int compare(const CompareCall& call)
{
    analyse::ColumnComparison comparison{columnTests.at(call.test), tails.at(call.alternative), {}};
    if (comparison.test == ColumnTest::Equivalence && call.alternative != "two-sided")
        throw protocols::badInput({"--alternative " + call.alternative + " does not apply to --test " + call.test,
                                   "--alternative", "no alternative: equivalence is two one-sided tests",
                                   "leave --alternative out"});
    const auto a = analyse::readColumn(call.csv, call.a, noteOnForm), b = analyse::readColumn(call.csv, call.b);
    if (comparison.test == ColumnTest::Equivalence) comparison.bounds = numbersInOrder(call.bounds, "--bounds", "-0.5,0.5");
    output(call.target, analyse::compareColumns(comparison, a, b));
    return 0;
}

struct MetricsCall {
    std::string a, b;
    std::optional<double> range;
    JsonTarget target;
};

int metrics(const MetricsCall& call)
{
    for (const auto& file : {call.a, call.b}) looking::requireNotOfOpenStudy(file);
    output(call.target, analyse::similarityOf(call.a, call.b, call.range));
    return 0;
}

void addDescribe(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("describe", "n, mean, SD, quartiles and more of a CSV column");
    auto call = std::make_shared<DescribeCall>();
    command->add_option("CSV", call->csv, "file with a header row")->required();
    command->add_option("--column", call->column, "name of the column")->required();
    addJsonOption(*command, call->target);
    command->callback([call, &action] { action.work = [call] { return describe(*call); }; });
}

void addCompare(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("compare", "a test between two columns of a CSV file (a - b)");
    auto call = std::make_shared<CompareCall>();
    command->add_option("CSV", call->csv, "file with a header row")->required();
    command->add_option("--a", call->a, "first column")->required();
    command->add_option("--b", call->b, "second column")->required();
    command->add_option("--test", call->test, "the test to use")
        ->check(CLI::IsMember({"paired", "welch", "student", "tost", "wilcoxon"}))
        ->capture_default_str();
    command->add_option("--bounds", call->bounds, "equivalence bounds for tost: LOW,HIGH")->capture_default_str();
    command->add_option("--alternative", call->alternative, "alternative hypothesis; less: a below b")
        ->check(CLI::IsMember({"two-sided", "less", "greater"}))
        ->capture_default_str();
    addJsonOption(*command, call->target);
    command->callback([call, &action] { action.work = [call] { return compare(*call); }; });
}

void addMetrics(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("metrics", "MAE and SSIM of two images or two one-column CSV traces");
    auto call = std::make_shared<MetricsCall>();
    command->add_option("A", call->a, "generated image or trace")->required();
    command->add_option("B", call->b, "true image or trace")->required();
    command->add_option("--range", call->range, "dynamic range L of SSIM")->check(aboveZero());
    addJsonOption(*command, call->target);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;  // Qt SQL checks whether a stimulus belongs to an open study
        action.work = [call] { return metrics(*call); };
    });
}

}  // namespace

void addNumbers(CLI::App& app, Action& action)
{
    addDescribe(app, action);
    addCompare(app, action);
    addMetrics(app, action);
}

}  // namespace study::commands
