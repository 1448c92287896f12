// vis2hap describe, compare and metrics: single numbers for scripts and for a look.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "protocols/files/csv_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/errors.h"
#include "rendering/images/image_io.h"
#include "rendering/signals/grey.h"
#include "stats/kernels/descriptive.h"
#include "stats/metrics/image_metrics.h"
#include "stats/metrics/trace_error.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/wilcoxon.h"
#include "study/analyse/statistic_json.h"
#include "study/commands/command_line.h"
#include "study/commands/csv_column.h"
#include "study/commands/json_output.h"
#include "study/commands/number_checks.h"
#include "study/looking/open_study.h"

namespace study::commands {

namespace {

using analyse::put;

using nlohmann::ordered_json;

/// The object as lines of text; nested objects are left to --json.
void tell(const JsonTarget& target, const ordered_json& json)
{
    if (target) return writeJson(target, json);
    for (const auto& [field, value] : json.items())
        if (field != "schema" && field != "why" && !value.is_object())
            std::printf("%-22s %s\n", field.c_str(), value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
    if (json.contains("effect"))
        std::printf("%-22s %s\n", json["effect"]["name"].get<std::string>().c_str(), json["effect"]["value"].dump().c_str());
    if (json.contains("why"))
        for (const auto& [field, reason] : json["why"].items())
            std::printf("%s does not exist: %s\n", field.c_str(), reason.get<std::string>().c_str());
}

// ---- describe

int describe(const std::string& csv, const std::string& column, const JsonTarget& target)
{
    const auto d = stats::describe(readColumn(csv, column));
    ordered_json json{{"schema", "vis2hap.describe/1"}, {"n", d.n}, {"missing", d.missing}};
    put(json, "mean", d.mean);
    put(json, "sd", d.sd);
    put(json, "variance", d.variance);
    put(json, "autocorrelation_lag1", d.autocorrelationLag1);
    put(json, "median", d.median);
    put(json, "q1", d.q1);
    put(json, "q3", d.q3);
    put(json, "min", d.min);
    put(json, "max", d.max);
    put(json, "ci95", d.ci95);
    tell(target, json);
    return 0;
}

// ---- compare

struct CompareCall {
    std::string csv, a, b, test = "paired", bounds = "-0.5,0.5", alternative = "two-sided";
    JsonTarget target;
};

const std::map<std::string, stats::Tail> tails{
    {"two-sided", stats::Tail::TwoSided}, {"less", stats::Tail::Less}, {"greater", stats::Tail::Greater}};

std::pair<double, double> boundsFrom(const std::string& text)
{
    const auto comma = text.find(',');
    const auto low = comma == std::string::npos ? std::nullopt : protocols::numberIn(text.substr(0, comma));
    const auto high = comma == std::string::npos ? std::nullopt : protocols::numberIn(text.substr(comma + 1));
    if (!low || !high || !(*low < *high))
        throw protocols::badInput(
            {"bounds \"" + text + "\"", "--bounds", "LOW,HIGH with LOW below HIGH, e.g. --bounds=-0.5,0.5", ""});
    return {*low, *high};
}

void putEffect(ordered_json& json, const char* name, const stats::Value& value)
{
    ordered_json effect{{"name", name}};
    put(effect, "value", value);
    json["effect"] = effect;
}

ordered_json tTestJson(const CompareCall& call, const std::vector<double>& a, const std::vector<double>& b)
{
    stats::TOptions options;
    options.tail = tails.at(call.alternative);
    const bool paired = call.test == "paired";
    const auto test = paired                   ? stats::pairedTTest(a, b, options)
                      : call.test == "student" ? stats::studentTTest(a, b, options)
                                               : stats::welchTTest(a, b, options);
    ordered_json json{{"schema", "vis2hap.compare/1"}, {"test", call.test}};
    json["n"] = paired ? ordered_json(test.n) : ordered_json{test.n, test.nSecond};
    put(json, "statistic", test.t);
    put(json, "df", test.df);
    put(json, "p", test.p);
    put(json, "log10_p", test.log10P());
    put(json, "mean_difference", test.estimate);
    put(json, "ci95", test.ci);
    putEffect(json, paired ? "d_z" : "g", paired ? test.dZ : test.hedgesGs);
    return json;
}

ordered_json tostJson(const CompareCall& call, const std::vector<double>& a, const std::vector<double>& b)
{
    const auto [low, high] = boundsFrom(call.bounds);
    const auto test = stats::equivalenceTest(stats::TKind::Paired, a, b, {low, high, 0.05});
    const auto difference = stats::pairedTTest(a, b);
    ordered_json json{{"schema", "vis2hap.compare/1"}, {"test", call.test}, {"n", test.n}};
    // The statistic of the pair of tests is the one that decides: the t nearer to its bound.
    const bool lowerDecides = test.pLower.orElse(0) >= test.pUpper.orElse(0);
    put(json, "statistic", lowerDecides ? test.tLower : test.tUpper);
    put(json, "df", test.df);
    put(json, "p", test.p);
    put(json, "log10_p", test.logP.exists() ? stats::Value(*test.logP / std::log(10.0)) : test.logP);
    put(json, "mean_difference", test.estimate);
    put(json, "ci95", difference.ci);
    putEffect(json, "d_z", test.dZ);
    json["bounds"] = {low, high};
    put(json, "p_lower", test.pLower);
    put(json, "p_upper", test.pUpper);
    put(json, "ci90", test.ci);
    json["equivalent"] = test.equivalent;
    json["verdict"] = test.verdict();
    return json;
}

ordered_json wilcoxonJson(const CompareCall& call, const std::vector<double>& a, const std::vector<double>& b)
{
    stats::WilcoxonOptions options;
    options.tail = tails.at(call.alternative);
    const auto test = stats::wilcoxonSignedRank(a, b, options);
    const auto difference = stats::pairedTTest(a, b);
    ordered_json json{{"schema", "vis2hap.compare/1"}, {"test", call.test}, {"n", test.nUsed + test.nZero}};
    put(json, "statistic", test.v);
    json["df"] = nullptr;
    json["why"]["df"] = "the signed-rank statistic has no degrees of freedom";
    const bool exact = test.pExact.exists();
    put(json, "p", exact ? test.pExact : test.pNormalCorrected);
    json["p_is"] = exact ? "exact" : "normal approximation with continuity correction";
    put(json, "log10_p",
        exact                                                          ? stats::Value(*test.logPExact / std::log(10.0))
        : test.pNormalCorrected.exists() && *test.pNormalCorrected > 0 ? stats::Value(std::log10(*test.pNormalCorrected))
                                                                       : stats::Value::undefined(test.why));
    put(json, "mean_difference", difference.estimate);
    put(json, "ci95", difference.ci);
    putEffect(json, "rank_biserial", test.rankBiserial);
    return json;
}

int compare(const CompareCall& call)
{
    const auto a = readColumn(call.csv, call.a), b = readColumn(call.csv, call.b);
    const bool twoSamples = call.test == "welch" || call.test == "student";
    const auto pairs = completePairs(a, b);
    const auto x = twoSamples ? present(a) : pairs.a, y = twoSamples ? present(b) : pairs.b;
    auto json = call.test == "tost"       ? tostJson(call, x, y)
                : call.test == "wilcoxon" ? wilcoxonJson(call, x, y)
                                          : tTestJson(call, x, y);
    json["missing"] = twoSamples ? a.size() - x.size() + b.size() - y.size() : pairs.missing;
    tell(call.target, json);
    return 0;
}

// ---- metrics

struct MetricsCall {
    std::string a, b;
    std::optional<double> range;
    JsonTarget target;
};

bool isTrace(const std::string& file) { return file.size() > 4 && file.substr(file.size() - 4) == ".csv"; }

std::vector<double> readTrace(const std::string& file)
{
    const auto table = protocols::readCsvTable(file);
    if (table.columns.size() != 1)
        throw protocols::badInput(
            {"has " + std::to_string(table.columns.size()) + " columns", file, "a trace of one column", ""});
    return readColumn(file, table.columns.front());
}

struct LoadedImage {
    cv::Mat values;  // CV_64F
    std::optional<double> range;
};

LoadedImage loadImage(const std::string& file)
{
    cv::Mat image = rendering::readImage(file);
    LoadedImage loaded;
    if (image.depth() == CV_8U)
        loaded.range = 255;
    else if (image.depth() == CV_16U)
        loaded.range = 65535;
    if (image.channels() == 3) {
        const int depth = image.depth();
        rendering::signals::grey(image).convertTo(image, depth);  // rounds, as OpenCV's own grey does
    }
    image.convertTo(loaded.values, CV_64F);
    return loaded;
}

ordered_json metricsJson(std::span<const double> a, std::span<const double> b)
{
    const auto error = stats::traceError(a, b);
    ordered_json json{{"schema", "vis2hap.metrics/1"}};
    put(json, "mae", error.mae);
    put(json, "mae_over_mean", error.maeOverMean);
    return json;
}

ordered_json imageMetrics(const MetricsCall& call)
{
    const auto a = loadImage(call.a), b = loadImage(call.b);
    if (a.values.size() != b.values.size())
        throw protocols::badInput(
            {"the images differ in size", call.a + " and " + call.b, "equal width and height", "crop or resample one"});
    const auto range = call.range ? call.range : b.range;
    if (!range)
        throw protocols::badInput(
            {"an image of floating-point values", call.b, "--range L, the dynamic range that SSIM needs", ""});
    const std::span<const double> x(a.values.ptr<double>(), a.values.total()), y(b.values.ptr<double>(), b.values.total());
    auto json = metricsJson(x, y);
    const auto width = static_cast<std::size_t>(a.values.cols), height = static_cast<std::size_t>(a.values.rows);
    const auto similarity = stats::ssim({x, width, height}, {y, width, height}, *range);
    put(json, "ssim", similarity.mean.exists() ? similarity.mean : stats::Value::undefined(similarity.why));
    return json;
}

int metrics(const MetricsCall& call)
{
    for (const auto& file : {call.a, call.b}) looking::requireNotOfOpenStudy(file);
    if (isTrace(call.a) != isTrace(call.b))
        throw protocols::badInput({"a trace and an image cannot be compared", call.a + " and " + call.b, "two of one kind", ""});
    if (!isTrace(call.a)) {
        tell(call.target, imageMetrics(call));
        return 0;
    }
    const auto a = readTrace(call.a), b = readTrace(call.b);
    if (a.size() != b.size())
        throw protocols::badInput({"the traces differ in length", call.a + " and " + call.b, "equal numbers of rows", ""});
    auto json = metricsJson(a, b);
    put(json, "ssim", stats::Value::undefined("SSIM is defined for images"));
    tell(call.target, json);
    return 0;
}

}  // namespace

void addNumbers(CLI::App& app, Action& action)
{
    auto* describeCommand = app.add_subcommand("describe", "n, mean, sd, quartiles and more of a CSV column");
    auto csv = std::make_shared<std::string>(), column = std::make_shared<std::string>();
    auto target = std::make_shared<JsonTarget>();
    describeCommand->add_option("CSV", *csv, "file with a header row")->required();
    describeCommand->add_option("--column", *column, "its name")->required();
    addJsonOption(*describeCommand, *target);
    describeCommand->callback([=, &action] { action.work = [=] { return describe(*csv, *column, *target); }; });

    auto* compareCommand = app.add_subcommand("compare", "a test between two columns of a CSV file (a - b)");
    auto call = std::make_shared<CompareCall>();
    compareCommand->add_option("CSV", call->csv, "file with a header row")->required();
    compareCommand->add_option("--a", call->a, "first column")->required();
    compareCommand->add_option("--b", call->b, "second column")->required();
    compareCommand->add_option("--test", call->test, "")
        ->check(CLI::IsMember({"paired", "welch", "student", "tost", "wilcoxon"}))
        ->capture_default_str();
    compareCommand->add_option("--bounds", call->bounds, "of tost: LOW,HIGH")->capture_default_str();
    compareCommand->add_option("--alternative", call->alternative, "less: a below b")
        ->check(CLI::IsMember({"two-sided", "less", "greater"}))
        ->capture_default_str();
    addJsonOption(*compareCommand, call->target);
    compareCommand->callback([call, &action] { action.work = [call] { return compare(*call); }; });

    auto* metricsCommand = app.add_subcommand("metrics", "MAE and SSIM of two images or two one-column CSV traces");
    auto images = std::make_shared<MetricsCall>();
    metricsCommand->add_option("A", images->a, "generated")->required();
    metricsCommand->add_option("B", images->b, "ground truth")->required();
    metricsCommand->add_option("--range", images->range, "dynamic range L of SSIM")->check(aboveZero());
    addJsonOption(*metricsCommand, images->target);
    metricsCommand->callback([images, &action] {
        action.surroundings = Surroundings::Core;  // to see whether a stimulus belongs to an open study
        action.work = [images] { return metrics(*images); };
    });
}

}  // namespace study::commands
