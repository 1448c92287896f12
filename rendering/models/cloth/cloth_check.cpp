#include "rendering/models/cloth/cloth_check.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/json_count.h"
#include "protocols/random.h"
#include "rendering/fabrics/drawn/drawn_patch.h"
#include "rendering/models/cloth/other_pictures.h"
#include "rendering/models/model_card.h"
#include "stats/kernels/threads.h"

namespace rendering::models {

namespace {

constexpr int termCount = 2 * clothFeatureCount + 1;
constexpr double farthest = 3;      ///< deviations; more say nothing more
constexpr double shrinkage = 3e-3;  ///< of the weights, per picture
constexpr int newtonSteps = 40, leastPictures = 100;
constexpr double unusualShare = 0.05, refusedShare = 0.01, flatShare = 0.2;
constexpr const char* checkSchema = "vis2hap.cloth_check/1";

using Terms = std::array<double, termCount>;

Terms termsOf(const ClothFeatures& features, const ClothCheck& check)
{
    Terms terms{};
    for (std::size_t i = 0; i < clothFeatureCount; ++i) {
        const double value = std::clamp((features[i] - check.mean[i]) / check.deviation[i], -farthest, farthest);
        terms[i] = value;
        terms[clothFeatureCount + i] = value * value - 1;
    }
    terms.back() = 1;
    return terms;
}

double scoreOf(const ClothFeatures& features, const ClothCheck& check)
{
    const Terms terms = termsOf(features, check);
    double sum = 0;
    for (std::size_t i = 0; i < termCount; ++i) sum += check.weights[i] * terms[i];
    return sum;
}

void standardise(ClothCheck& check, const std::vector<ClothFeatures>& cloth)
{
    for (std::size_t i = 0; i < clothFeatureCount; ++i) {
        double sum = 0, squares = 0;
        for (const ClothFeatures& one : cloth) sum += one[i] / double(cloth.size());
        for (const ClothFeatures& one : cloth) squares += (one[i] - sum) * (one[i] - sum) / double(cloth.size());
        check.mean[i] = sum;
        check.deviation[i] = std::sqrt(squares) + 1e-6;
    }
}

/// Newton's method for logistic regression with a ridge; the constant is free.
void fitWeights(ClothCheck& check, const std::vector<ClothFeatures>& cloth, const std::vector<ClothFeatures>& others)
{
    const double count = double(cloth.size() + others.size());
    check.weights.assign(termCount, 0);
    for (int step = 0; step < newtonSteps; ++step) {
        cv::Mat slope = cv::Mat::zeros(termCount, 1, CV_64F), curve = cv::Mat::zeros(termCount, termCount, CV_64F), change;
        for (int i = 0; i < termCount; ++i) {
            const double ridge = i + 1 < termCount ? shrinkage * count : 1e-6 * count;
            slope.at<double>(i) = ridge * check.weights[std::size_t(i)];
            curve.at<double>(i, i) = ridge;
        }
        for (const auto& [pictures, wanted] : {std::pair{&cloth, 0.0}, {&others, 1.0}})
            for (const ClothFeatures& features : *pictures) {
                Terms terms = termsOf(features, check);
                const double odds = 1 / (1 + std::exp(-std::clamp(scoreOf(features, check), -30.0, 30.0)));
                const cv::Mat column(termCount, 1, CV_64F, terms.data());
                slope += (odds - wanted) * column;
                curve += odds * (1 - odds) * (column * column.t());
            }
        cv::solve(curve, slope, change, cv::DECOMP_CHOLESKY);
        for (int i = 0; i < termCount; ++i) check.weights[std::size_t(i)] -= change.at<double>(i);
        if (cv::norm(change) < 1e-9) break;
    }
}

template <class Draw>
std::vector<ClothFeatures> featuresOf(int count, unsigned threads, const std::function<void(int)>& report, const Draw& draw)
{
    std::vector<ClothFeatures> features(static_cast<std::size_t>(count));
    stats::onThreads(
        features.size(), threads, [&](std::size_t i) { features[i] = clothFeatures(draw(i)); },
        [&](std::size_t done) {
            if (report) report(static_cast<int>(done));
        });
    return features;
}

/// Rounded to five significant digits.
double fiveDigits(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return std::strtod(text, nullptr);
}

template <class Numbers>
nlohmann::ordered_json numbersJson(const Numbers& numbers)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const double value : numbers) json.push_back(fiveDigits(value));
    return json;
}

}  // namespace

std::string nameOf(ClothLikeness likeness)
{
    switch (likeness) {
        case ClothLikeness::Cloth:
            return "cloth";
        case ClothLikeness::Unusual:
            return "unusual";
        case ClothLikeness::NotCloth:
            return "not_cloth";
    }
    return {};
}

double ClothCheck::score(const cv::Mat& rgb) const { return scoreOf(clothFeatures(rgb), *this); }

ClothLikeness ClothCheck::likenessOf(double score) const
{
    return score > refusedAbove ? ClothLikeness::NotCloth : score > unusualAbove ? ClothLikeness::Unusual : ClothLikeness::Cloth;
}

cv::Mat drawnClothPicture(std::uint64_t seed, std::uint64_t index)
{
    static constexpr int sides[] = {128, 192, 256, 384};
    const int side = sides[protocols::Random::stream(seed, "cloth picture/" + std::to_string(index)).below(4)];
    const fabrics::DrawnFabric fabric = fabrics::drawFabric(seed, index);
    return fabrics::drawPatchOf(fabric, 1, seed, index, {side, flatShare}).rgb;
}

ClothCheck fitClothCheck(std::uint64_t seed, int pictures, unsigned threads, const std::function<void(int, int)>& report)
{
    if (pictures < leastPictures)
        throw protocols::badInput({std::to_string(pictures) + " pictures are too few", "--pictures",
                                   "at least " + std::to_string(leastPictures), "use more"});
    ClothCheck check;
    check.seed = seed;
    check.pictures = pictures;
    const int total = 3 * pictures;
    const auto from = [&](int before) -> std::function<void(int)> {
        return [&report, before, total](int done) {
            if (report) report(before + done, total);
        };
    };
    const auto cloth = [&](std::uint64_t family) { return [family](std::size_t i) { return drawnClothPicture(family, i); }; };
    const auto known = featuresOf(pictures, threads, from(0), cloth(seed));
    const auto others = featuresOf(pictures, threads, from(pictures), [&](std::size_t i) { return drawOtherPicture(seed, i); });
    const auto fresh = featuresOf(pictures, threads, from(2 * pictures), cloth(~seed));
    standardise(check, known);
    fitWeights(check, known, others);
    std::vector<double> scores;
    for (const ClothFeatures& one : fresh) scores.push_back(scoreOf(one, check));
    std::sort(scores.begin(), scores.end());
    const auto above = [&](double share) { return scores[std::size_t((1 - share) * double(scores.size() - 1))]; };
    check.unusualAbove = above(unusualShare);
    check.refusedAbove = above(refusedShare);
    return check;
}

ClothCheckFigures clothCheckFigures(const ClothCheck& check, std::uint64_t seed, int pictures)
{
    const auto cloth = featuresOf(pictures, 0, {}, [&](std::size_t i) { return drawnClothPicture(seed, i); });
    const auto others = featuresOf(pictures, 0, {}, [&](std::size_t i) { return drawOtherPicture(seed, i); });
    const auto above = [&](const std::vector<ClothFeatures>& all, double limit) {
        return double(std::count_if(all.begin(), all.end(), [&](const auto& one) { return scoreOf(one, check) > limit; })) /
               double(all.size());
    };
    const double refused = above(cloth, check.refusedAbove);
    return {above(cloth, check.unusualAbove) - refused, refused, above(others, check.refusedAbove)};
}

void writeClothCheck(const std::filesystem::path& file, const ClothCheck& check)
{
    const nlohmann::ordered_json json{{"schema", checkSchema},
                                      {"seed", check.seed},
                                      {"pictures", check.pictures},
                                      {"unusual_above", fiveDigits(check.unusualAbove)},
                                      {"refused_above", fiveDigits(check.refusedAbove)},
                                      {"mean", numbersJson(check.mean)},
                                      {"deviation", numbersJson(check.deviation)},
                                      {"weights", numbersJson(check.weights)}};
    protocols::writeWholeFile(file, json.dump(1) + "\n");
}

ClothCheck readClothCheck(const std::filesystem::path& file)
{
    const auto refused = [&](const std::string& what) {
        return protocols::badInput({"is no check of cloth: " + what, file.string(), checkSchema,
                                    "make it with `vis2hap train --cloth-check --out FILE`"});
    };
    ClothCheck check;
    try {
        const auto json = protocols::parseStrictJson(protocols::readWholeFile(file), file.string());
        if (json.at("schema") != checkSchema) throw refused("another schema");
        check.seed = protocols::seedIn(json, "seed");
        check.pictures = protocols::countIn(json, "pictures");
        check.unusualAbove = json.at("unusual_above").get<double>();
        check.refusedAbove = json.at("refused_above").get<double>();
        check.mean = json.at("mean").get<ClothFeatures>();
        check.deviation = json.at("deviation").get<ClothFeatures>();
        check.weights = json.at("weights").get<std::vector<double>>();
    } catch (const nlohmann::json::exception& fault) {
        throw refused(fault.what());
    } catch (const std::out_of_range& fault) {
        throw refused(fault.what());
    }
    if (check.weights.size() != termCount) throw refused("weights has another length");
    if (!std::all_of(check.deviation.begin(), check.deviation.end(), [](double one) { return one > 0; }))
        throw refused("a deviation is not positive");
    return check;
}

const ClothCheck& shippedClothCheck()
{
    static const ClothCheck check = readClothCheck(shippedModel().parent_path() / "cloth-check.json");
    return check;
}

}  // namespace rendering::models
