#include "rendering/signals/tactile/slope_map_fit.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "protocols/random.h"

namespace rendering::signals {

namespace {

constexpr double weightDecay = 4e-5;  ///< regularises the network between distant presses

int inputCount(const SlopeSamples& samples, bool byPlace) { return samples.channels + (byPlace ? 2 : 0); }

/// Inputs of a map, one row for each sample.
cv::Mat inputsOf(const SlopeSamples& samples, bool byPlace, double lightScale)
{
    const auto channels = static_cast<std::size_t>(samples.channels);
    cv::Mat inputs(static_cast<int>(samples.size()), inputCount(samples, byPlace), CV_64FC1);
    for (std::size_t s = 0; s < samples.size(); ++s) {
        double* row = inputs.ptr<double>(static_cast<int>(s));
        for (std::size_t c = 0; c < channels; ++c) row[c] = lightScale * samples.light[s * channels + c];
        if (byPlace) std::copy_n(samples.places.data() + 2 * s, 2, row + channels);
    }
    return inputs;
}

cv::Mat targetsOf(const SlopeSamples& samples)
{
    cv::Mat targets;
    cv::Mat(static_cast<int>(samples.size()), 2, CV_32FC1, const_cast<float*>(samples.slopes.data())).convertTo(targets, CV_64F);
    return targets;
}

void requireEnough(std::size_t samples, std::size_t unknowns)
{
    if (samples < 10 * unknowns)
        throw protocols::badInput({.what = "there are too few pixels of known slope (" + std::to_string(samples) +
                                           ") for a map of " + std::to_string(unknowns) + " numbers",
                                   .where = "",
                                   .expected = "ten pixels for each number",
                                   .nextStep = "press the ball at more places, or choose --quality fast"});
}

/// Correction for attenuation: the inverse slope of the regression of the fitted on the known values.
double attenuationCorrection(const cv::Mat& found, const cv::Mat& known)
{
    const double together = found.dot(known);
    return together > 0 ? known.dot(known) / together : 1;
}

/// Ridge regression with correction for attenuation. `terms`: one row for each sample.
cv::Mat leastSquares(const cv::Mat& terms, const cv::Mat& targets, double ridge)
{
    cv::Mat normal = terms.t() * terms, solution;
    normal += ridge * terms.rows * cv::Mat::eye(terms.cols, terms.cols, CV_64FC1);
    cv::solve(normal, terms.t() * targets, solution, cv::DECOMP_CHOLESKY);
    return solution * attenuationCorrection(terms * solution, targets);
}

cv::Mat termsOf(const cv::Mat& inputs, int degree)
{
    const auto all = monomials(inputs.cols, degree);
    cv::Mat terms(inputs.rows, static_cast<int>(all.size()), CV_64FC1);
    for (int s = 0; s < inputs.rows; ++s) {
        const double* input = inputs.ptr<double>(s);
        double* term = terms.ptr<double>(s);
        term[0] = 1;
        for (std::size_t m = 1; m < all.size(); ++m) term[m] = term[all[m].parent] * input[all[m].factor];
    }
    return terms;
}

std::array<std::vector<double>, 2> columnsOf(const cv::Mat& solution)
{
    std::array<std::vector<double>, 2> columns;
    for (int k = 0; k < solution.rows; ++k)
        for (std::size_t axis = 0; axis < 2; ++axis) columns[axis].push_back(solution.at<double>(k, static_cast<int>(axis)));
    return columns;
}

SlopeMap linearFit(const SlopeSamples& samples, const FitOptions& options)
{
    const auto columns = columnsOf(leastSquares(termsOf(inputsOf(samples, false, 1), 1), targetsOf(samples), options.ridge));
    LinearMap map;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        map.offset[axis] = columns[axis].front();
        map.gain[axis].assign(columns[axis].begin() + 1, columns[axis].end());
    }
    return map;
}

/// Products that contain light; the others would give the untouched sensor a slope.
std::vector<int> litTerms(int inputs, int channels, int degree)
{
    const auto all = monomials(inputs, degree);
    std::vector<bool> lit(all.size(), false);
    std::vector<int> chosen;
    for (std::size_t m = 1; m < all.size(); ++m) {
        lit[m] = all[m].factor < channels || lit[static_cast<std::size_t>(all[m].parent)];
        if (lit[m]) chosen.push_back(static_cast<int>(m));
    }
    return chosen;
}

SlopeMap polynomialFit(const SlopeSamples& samples, const FitOptions& options)
{
    const cv::Mat terms = termsOf(inputsOf(samples, options.byPlace, options.lightScale), options.degree);
    const auto chosen = litTerms(inputCount(samples, options.byPlace), samples.channels, options.degree);
    cv::Mat lit(terms.rows, static_cast<int>(chosen.size()), CV_64FC1), all = cv::Mat::zeros(terms.cols, 2, CV_64FC1);
    for (int k = 0; k < lit.cols; ++k) terms.col(chosen[static_cast<std::size_t>(k)]).copyTo(lit.col(k));
    const cv::Mat solution = leastSquares(lit, targetsOf(samples), options.ridge);
    for (int k = 0; k < lit.cols; ++k) solution.row(k).copyTo(all.row(chosen[static_cast<std::size_t>(k)]));
    return PolynomialMap{options.degree, options.byPlace, options.lightScale, columnsOf(all)};
}

/// A layer during training.
struct Layer {
    cv::Mat weights;     ///< [units x (inputs + 1)]
    cv::Mat steps;       ///< step size of each weight
    cv::Mat gradient;    ///< gradient in the previous step
    cv::Mat activation;  ///< [samples x units]
};

cv::Mat withBias(const cv::Mat& inputs)
{
    cv::Mat result;
    cv::hconcat(inputs, cv::Mat::ones(inputs.rows, 1, CV_64FC1), result);
    return result;
}

void tanhOf(cv::Mat& values)
{
    for (double& value : cv::Mat_<double>(values)) value = std::tanh(value);
}

class TrainedNetwork {
public:
    TrainedNetwork(const std::vector<int>& sizes, std::uint64_t seed)
    {
        protocols::Random random(seed);
        for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
            Layer layer;
            layer.weights.create(sizes[i + 1], sizes[i] + 1, CV_64FC1);
            for (double& w : cv::Mat_<double>(layer.weights)) w = random.normal() / std::sqrt(sizes[i] + 1.0);
            layer.steps = cv::Mat(layer.weights.size(), CV_64FC1, cv::Scalar(0.01));
            layer.gradient = cv::Mat::zeros(layer.weights.size(), CV_64FC1);
            m_layers.push_back(layer);
        }
    }

    cv::Mat outputs(const cv::Mat& inputs)
    {
        cv::Mat values = inputs;
        for (std::size_t i = 0; i < m_layers.size(); ++i) {
            m_layers[i].activation = withBias(values) * m_layers[i].weights.t();
            if (i + 1 < m_layers.size()) tanhOf(m_layers[i].activation);
            values = m_layers[i].activation;
        }
        return values;
    }

    /// Slopes minus those at rest. `inputs` holds the samples, followed by the same places without light.
    cv::Mat slopes(const cv::Mat& inputs)
    {
        const cv::Mat all = outputs(inputs);
        return all.rowRange(0, all.rows / 2) - all.rowRange(all.rows / 2, all.rows);
    }

    void step(const cv::Mat& inputs, const cv::Mat& targets)
    {
        const cv::Mat deviation = (slopes(inputs) - targets) / targets.rows;
        cv::Mat error;
        cv::vconcat(deviation, -deviation, error);
        for (std::size_t i = m_layers.size(); i-- > 0;) {
            const cv::Mat from = i == 0 ? inputs : m_layers[i - 1].activation;
            const cv::Mat gradient = error.t() * withBias(from) + weightDecay * m_layers[i].weights;
            if (i > 0) {
                const cv::Mat& weights = m_layers[i].weights;
                error = (error * weights.colRange(0, weights.cols - 1)).mul(1 - from.mul(from));
            }
            move(m_layers[i], gradient);
        }
    }

    void scaleOutputs(double factor) { m_layers.back().weights *= factor; }
    std::vector<std::vector<double>> weights() const
    {
        std::vector<std::vector<double>> all;
        for (const auto& layer : m_layers) all.emplace_back(layer.weights.begin<double>(), layer.weights.end<double>());
        return all;
    }

private:
    static void move(Layer& layer, const cv::Mat& gradient)
    {
        for (int i = 0; i < gradient.rows; ++i)
            for (int j = 0; j < gradient.cols; ++j) {
                double now = gradient.at<double>(i, j);
                double& before = layer.gradient.at<double>(i, j);
                double& step = layer.steps.at<double>(i, j);
                if (now * before > 0) step = std::min(1.0, 1.2 * step);
                if (now * before < 0) {
                    step = std::max(1e-7, 0.5 * step);
                    now = 0;
                }
                layer.weights.at<double>(i, j) -= (now > 0) ? step : (now < 0) ? -step : 0;
                before = now;
            }
    }

    std::vector<Layer> m_layers;
};

cv::Mat everyNthRow(const cv::Mat& rows, int most)
{
    if (rows.rows <= most) return rows;
    cv::Mat chosen(most, rows.cols, rows.type());
    for (int i = 0; i < most; ++i)
        rows.row(static_cast<int>(static_cast<std::int64_t>(i) * rows.rows / most)).copyTo(chosen.row(i));
    return chosen;
}

SlopeMap networkFit(const SlopeSamples& samples, const FitOptions& options)
{
    const cv::Mat inputs = everyNthRow(inputsOf(samples, options.byPlace, options.lightScale), options.networkSamples);
    const cv::Mat targets = everyNthRow(targetsOf(samples), options.networkSamples);
    NetworkMap map{options.byPlace, options.lightScale, {inputs.cols, 24, 24, 2}, {}};
    TrainedNetwork network(map.sizes, options.seed);
    cv::Mat rest = inputs.clone(), both;
    rest.colRange(0, samples.channels) = 0;
    cv::vconcat(inputs, rest, both);
    for (int i = 0; i < options.networkSteps; ++i) network.step(both, targets);
    network.scaleOutputs(attenuationCorrection(network.slopes(both), targets));
    map.weights = network.weights();
    return map;
}

}  // namespace

void SlopeSamples::add(const cv::Mat& frame, const Slopes& known, const cv::Mat& chosen, int step)
{
    CV_Assert(frame.depth() == CV_32F && frame.channels() == channels);
    int passed = 0;
    for (int i = 0; i < frame.rows; ++i)
        for (int j = 0; j < frame.cols; ++j) {
            if (!chosen.at<uchar>(i, j) || passed++ % step != 0) continue;
            const float* pixel = frame.ptr<float>(i) + static_cast<std::ptrdiff_t>(j) * channels;
            light.insert(light.end(), pixel, pixel + channels);
            places.insert(places.end(), {frameCoordinate(j, frame.cols), frameCoordinate(i, frame.rows)});
            slopes.insert(slopes.end(), {known.x.at<float>(i, j), known.y.at<float>(i, j)});
        }
}

SlopeMap fitSlopeMap(const SlopeSamples& samples, const FitOptions& options)
{
    const int inputs = inputCount(samples, options.byPlace);
    switch (options.quality) {
        case MapQuality::Fast:
            requireEnough(samples.size(), static_cast<std::size_t>(samples.channels + 1));
            return linearFit(samples, options);
        case MapQuality::Balanced:
            requireEnough(samples.size(), monomials(inputs, options.degree).size());
            return polynomialFit(samples, options);
        case MapQuality::Accurate:
            requireEnough(samples.size(), static_cast<std::size_t>(24 * (inputs + 1)));
            return networkFit(samples, options);
    }
    return {};
}

}  // namespace rendering::signals
