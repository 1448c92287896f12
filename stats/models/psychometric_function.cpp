#include "stats/models/psychometric_function.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include "stats/kernels/distributions.h"
#include "stats/kernels/exact_sum.h"
#include "stats/kernels/matrix.h"

namespace stats {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double normalDensity(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi); }

/// Parameters: shift and slope of eta = shift + slope z, where z is the standardised level, and the lapse rate.
using Parameters = std::array<double, 3>;

/// What a profile of the likelihood holds fixed.
struct Restriction {
    enum class Kind { None, Threshold, Slope } kind = Kind::None;
    double at = 0;                ///< the threshold, standardised; or the slope
    std::optional<double> share;  ///< probability correct at the threshold; none: half way
};

struct LikelihoodPoint {
    double logLikelihood = -infinite;  ///< without the binomial coefficients
    std::vector<double> score;
    Matrix information;
};

/// Log likelihood with Fisher's information, restricted or not.
class PsychometricLikelihood {
public:
    PsychometricLikelihood(std::vector<LevelCounts> standardised, const PsychometricOptions& options)
        : m_counts(std::move(standardised)), m_options(options), m_chance(1.0 / options.alternatives)
    {
    }

    /// eta where a correct choice has this probability, which depends on the lapse rate, and its derivative; 0 half way.
    std::pair<double, double> etaAt(const std::optional<double>& probability, double lapse) const
    {
        if (!probability) return {0, 0};
        const double range = 1 - m_chance - lapse, share = (*probability - m_chance) / range;
        const double eta = -normalQuantile(share);
        return {eta, share / range / normalDensity(eta)};
    }

    /// The shift that the restriction leaves for this slope and lapse rate.
    double shiftOf(const Restriction& restriction, const Parameters& parameters) const
    {
        if (restriction.kind != Restriction::Kind::Threshold) return parameters[0];
        return etaAt(restriction.share, parameters[2]).first - parameters[1] * restriction.at;
    }

    double probability(const Parameters& parameters, double z) const
    {
        const double eta = parameters[0] + parameters[1] * z;
        return m_chance + (1 - m_chance - parameters[2]) * normalLower(eta);
    }

    double logLikelihood(const Parameters& parameters) const
    {
        ExactSum sum;
        for (const LevelCounts& one : m_counts) {
            const double eta = parameters[0] + parameters[1] * one.level, range = 1 - m_chance - parameters[2];
            if (one.correct > 0) sum.add(one.correct * std::log(m_chance + range * normalLower(eta)));
            if (one.correct < one.trials)
                sum.add((one.trials - one.correct) * std::log(parameters[2] + range * normalLower(-eta)));
        }
        const double total = sum.total();
        return std::isnan(total) ? -infinite : total;
    }

    /// Derivatives in the free parameters of the restriction: [shift, slope, lapse] without those that it fixes.
    LikelihoodPoint at(const Parameters& parameters, const Restriction& restriction, bool freeLapse) const
    {
        const auto [etaThere, etaChange] = etaAt(restriction.share, parameters[2]);
        const std::size_t free = (restriction.kind == Restriction::Kind::None ? 2 : 1) + (freeLapse ? 1 : 0);
        LikelihoodPoint point{logLikelihood(parameters), std::vector<double>(free), Matrix(free, free)};
        for (const LevelCounts& one : m_counts) {
            const double eta = parameters[0] + parameters[1] * one.level, range = 1 - m_chance - parameters[2];
            const double share = normalLower(eta), p = m_chance + range * share;
            const double q = parameters[2] + range * normalLower(-eta), steep = range * normalDensity(eta);
            if (!(p > 0) || !(q > 0)) continue;
            std::vector<double> change;
            double lapseChange = -share;
            if (restriction.kind == Restriction::Kind::Threshold) {
                change = {steep * (one.level - restriction.at)};
                lapseChange += steep * etaChange;
            } else if (restriction.kind == Restriction::Kind::Slope)
                change = {steep};
            else
                change = {steep, steep * one.level};
            if (freeLapse) change.push_back(lapseChange);
            const double residual = (one.correct - one.trials * p) / (p * q), weight = one.trials / (p * q);
            for (std::size_t i = 0; i < free; ++i) {
                point.score[i] += residual * change[i];
                for (std::size_t j = 0; j < free; ++j) point.information(i, j) += weight * change[i] * change[j];
            }
        }
        return point;
    }

    /// The parameters after a step of the free ones.
    Parameters moved(const Parameters& from, std::span<const double> step, double fraction, const Restriction& restriction,
                     bool freeLapse) const
    {
        Parameters to = from;
        std::size_t next = 0;
        if (restriction.kind != Restriction::Kind::Threshold) to[0] += fraction * step[next++];
        if (restriction.kind != Restriction::Kind::Slope) to[1] += fraction * step[next++];
        if (freeLapse) to[2] = std::clamp(from[2] + fraction * step[next], 0.0, m_options.lapse.most);
        to[0] = shiftOf(restriction, to);
        return to;
    }

    const PsychometricOptions& options() const { return m_options; }
    const std::vector<LevelCounts>& counts() const { return m_counts; }
    double chance() const { return m_chance; }

private:
    std::vector<LevelCounts> m_counts;  // standardised levels
    const PsychometricOptions& m_options;
    double m_chance;
};

struct Maximum {
    Parameters place{};
    double logLikelihood = -infinite;
    bool freeLapse = false;  ///< estimated, and not at a limit
};

/// Halves the step until the likelihood rises; false where it never does.
bool rises(const PsychometricLikelihood& likelihood, Maximum& best, std::span<const double> step, const Restriction& restriction)
{
    for (double fraction = 1; fraction > 1e-10; fraction /= 2) {
        const Parameters next = likelihood.moved(best.place, step, fraction, restriction, best.freeLapse);
        const double value = likelihood.logLikelihood(next);
        if (!(value > best.logLikelihood)) continue;
        best.place = next;
        best.logLikelihood = value;
        return true;
    }
    return false;
}

/// Fisher scoring from one start. A lapse rate that would leave its limits stays at the limit.
Maximum climbed(const PsychometricLikelihood& likelihood, Parameters place, const Restriction& restriction)
{
    constexpr int mostSteps = 200;
    const LapseRate& lapse = likelihood.options().lapse;
    place[0] = likelihood.shiftOf(restriction, place);
    Maximum best{place, likelihood.logLikelihood(place), lapse.estimated};
    for (int step = 0; step < mostSteps; ++step) {
        best.freeLapse = lapse.estimated;
        LikelihoodPoint point = likelihood.at(best.place, restriction, best.freeLapse);
        if (lapse.estimated) {
            const double pull = point.score.back();
            if ((best.place[2] <= 0 && pull < 0) || (best.place[2] >= lapse.most && pull > 0)) {
                best.freeLapse = false;
                point = likelihood.at(best.place, restriction, false);
            }
        }
        const std::vector<double> direction = solved(point.information, point.score);
        if (direction.empty()) break;
        const double gain = dot(direction, point.score);
        // So near the maximum the likelihood itself is rounding error: the score decides alone.
        if (gain < 1e-9) {
            best.place = likelihood.moved(best.place, direction, 1, restriction, best.freeLapse);
            if (gain < 1e-22) break;
        } else if (!rises(likelihood, best, direction, restriction))
            break;
    }
    best.logLikelihood = likelihood.logLikelihood(best.place);
    return best;
}

/// Slopes around that of a gentle rise over the standardised levels, with their midpoints.
std::vector<Parameters> startsOf(const PsychometricLikelihood& likelihood)
{
    const LapseRate& lapse = likelihood.options().lapse;
    std::vector<double> rates{lapse.fixed};
    if (lapse.estimated) rates = {lapse.most / 10, lapse.most / 2};
    std::vector<Parameters> starts;
    for (const double slope : {0.3, 1.0, 3.0, 10.0})
        for (const double middle : {-1.5, -0.5, 0.5, 1.5})
            for (const double rate : rates) starts.push_back({-slope * middle, slope, rate});
    return starts;
}

/// The best maximum that is reached from the best starts, because the likelihood may have more than one.
Maximum maximised(const PsychometricLikelihood& likelihood)
{
    constexpr std::size_t climbs = 4;
    std::vector<std::pair<double, Parameters>> starts;
    for (const Parameters& start : startsOf(likelihood)) starts.emplace_back(likelihood.logLikelihood(start), start);
    std::ranges::stable_sort(starts, std::greater<>(), &std::pair<double, Parameters>::first);
    Maximum best;
    for (std::size_t i = 0; i < climbs; ++i)
        if (const Maximum one = climbed(likelihood, starts[i].second, {}); one.logLikelihood > best.logLikelihood) best = one;
    return best;
}

/// Levels in ascending order, with the counts of equal levels added up.
std::vector<LevelCounts> addedUp(std::span<const LevelCounts> counts)
{
    std::map<double, LevelCounts> byLevel;
    for (const LevelCounts& one : counts) {
        LevelCounts& sum = byLevel[one.level];
        sum.level = one.level;
        sum.correct += one.correct;
        sum.trials += one.trials;
    }
    std::vector<LevelCounts> result;
    for (const auto& [level, sum] : byLevel)
        if (sum.trials > 0) result.push_back(sum);
    return result;
}

std::string faultOfCounts(std::span<const LevelCounts> counts)
{
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto& [level, correct, trials] = counts[i];
        const std::string where = "row " + std::to_string(i + 1);
        if (!std::isfinite(level)) return where + " has a level that is not a number";
        if (!(correct >= 0 && correct <= trials) || !std::isfinite(trials) || std::floor(correct) != correct ||
            std::floor(trials) != trials)
            return where + " has impossible counts; expected 0 <= correct <= trials, whole numbers";
    }
    return {};
}

std::string faultOfOptions(const PsychometricOptions& options)
{
    const double chance = 1.0 / options.alternatives, lapse = options.lapse.estimated ? options.lapse.most : options.lapse.fixed;
    if (options.alternatives < 2) return "needs at least 2 alternatives";
    if (!(lapse >= 0 && lapse < 1 - chance)) return "the lapse rate must lie between 0 and 1 - 1/m";
    if (options.thresholdAt && !(*options.thresholdAt > chance && *options.thresholdAt < 1 - lapse))
        return "the probability at the threshold must lie between chance and 1 - lapse";
    return {};
}

std::string faultOfLevels(const std::vector<LevelCounts>& levels)
{
    double correct = 0, trials = 0;
    for (const LevelCounts& one : levels) {
        correct += one.correct;
        trials += one.trials;
    }
    if (trials == 0) return "there are no trials";
    if (correct == trials) return "all choices are correct: the threshold lies below these levels";
    if (correct == 0) return "all choices are wrong";
    if (levels.size() < 2) return "there is one level only: a rise needs at least 2";
    return {};
}

/// The reason why the fit is no maximum of the likelihood; else empty.
std::string faultOfFit(const PsychometricLikelihood& likelihood, const Maximum& best)
{
    constexpr double flat = 4.8;  // |eta| from which Phi differs from 0 or 1 by less than 1e-6
    std::size_t below = 0, above = 0;
    for (const LevelCounts& one : likelihood.counts()) {
        const double eta = best.place[0] + best.place[1] * one.level;
        below += eta < -flat ? 1 : 0;
        above += eta > flat ? 1 : 0;
    }
    const std::size_t levels = likelihood.counts().size();
    if (!std::isfinite(best.logLikelihood)) return "no start has a finite likelihood";
    if (below == levels) return "no level has a share of correct choices above chance";
    if (above == levels) return "every level lies on the upper end of the function";
    if (!(best.place[1] > 1e-6)) return "the share of correct choices does not rise with the level";
    if (below + above + 1 >= levels) return "the shares rise in one step between two levels: the likelihood has no maximum";
    return {};
}

/// The end of a profile interval: where twice the drop of the log likelihood reaches the quantile. `drop` is 0 at `inside`.
template <typename Drop>
double profileEnd(double inside, double firstStep, double quantile, Drop drop)
{
    double near = inside, step = firstStep, far = inside + step;
    for (int doubled = 0; drop(far) < quantile; ++doubled) {
        if (doubled == 30) return firstStep > 0 ? infinite : -infinite;
        near = far;
        step *= 2;
        far = inside + step;
    }
    // False position with halved weights (Illinois).
    double low = drop(near) - quantile, high = drop(far) - quantile;
    for (int tries = 0; tries < 60 && std::fabs(far - near) > 1e-10 * (1 + std::fabs(far)); ++tries) {
        const double between = far - high * (far - near) / (high - low), rest = drop(between) - quantile;
        if ((rest < 0) == (high < 0))
            low /= 2;
        else {
            near = far;
            low = high;
        }
        far = between;
        high = rest;
        if (rest == 0) break;
    }
    return far;
}

/// Estimates in the unit of the levels, from the standardised fit.
class PsychometricReport {
public:
    PsychometricReport(const PsychometricLikelihood& likelihood, const Maximum& best, double centre, double unit)
        : m_likelihood(likelihood), m_best(best), m_centre(centre), m_unit(unit)
    {
        const LikelihoodPoint point = likelihood.at(best.place, {}, best.freeLapse);
        const std::size_t free = point.score.size();
        Matrix factor = point.information;
        if (factorise(factor) == free) m_covariance = inverseFrom(inverseOfTransposed(factor, free), free);
        const double z = normalQuantile((1 - likelihood.options().confidence) / 2);
        m_z = z;
    }

    void put(PsychometricFit& fit) const
    {
        const double shift = m_best.place[0], slope = m_best.place[1], lapse = m_best.place[2];
        const auto [eta, etaChange] = m_likelihood.etaAt(m_likelihood.options().thresholdAt, lapse);
        fit.mu = estimate(m_centre - m_unit * shift / slope, {-1 / slope, shift / (slope * slope), 0});
        fit.sigma = estimate(m_unit / slope, {0, -1 / (slope * slope), 0});
        fit.threshold =
            estimate(m_centre + m_unit * (eta - shift) / slope, {-1 / slope, (shift - eta) / (slope * slope), etaChange / slope});
        putProfiles(fit, (eta - shift) / slope, slope);
        fit.lapse = lapse;
        const bool estimated = m_likelihood.options().lapse.estimated;
        fit.lapseAtLimit = estimated && !m_best.freeLapse;
        if (m_best.freeLapse && m_covariance.rows() == 3)
            fit.seLapse = std::sqrt(m_covariance(2, 2));
        else
            fit.seLapse = Value::undefined(estimated ? "the lapse rate is at a limit" : "the lapse rate is fixed");
    }

private:
    /// `gradient`: derivatives of the standardised quantity in shift, slope and lapse rate.
    PsychometricEstimate estimate(double value, const Parameters& gradient) const
    {
        PsychometricEstimate result;
        result.estimate = value;
        if (m_covariance.rows() == 0) {
            result.se = Value::undefined("the information matrix is singular");
            result.wald = {result.se, result.se};
            return result;
        }
        const auto weights = std::span(gradient).first(m_covariance.rows());
        const double se = m_unit * std::sqrt(quadraticForm(weights, m_covariance, weights));
        result.se = se;
        result.wald = {value - m_z * se, value + m_z * se};
        return result;
    }

    double dropAt(const Restriction& restriction, const Parameters& start) const
    {
        return 2 * (m_best.logLikelihood - climbed(m_likelihood, start, restriction).logLikelihood);
    }

    void putProfiles(PsychometricFit& fit, double threshold, double slope) const
    {
        const double quantile = m_z * m_z;
        fit.threshold.profile = thresholdProfile(m_likelihood.options().thresholdAt, threshold);
        fit.mu.profile = thresholdProfile(std::nullopt, -m_best.place[0] / slope);
        // The logarithm of the slope keeps the profile above 0.
        const auto slopeDrop = [&](double logarithm) {
            Parameters start = m_best.place;
            start[1] = std::exp(logarithm);
            start[0] *= start[1] / slope;
            return dropAt({Restriction::Kind::Slope, start[1], {}}, start);
        };
        const double steepest = profileEnd(std::log(slope), 0.1, quantile, slopeDrop);
        const double flattest = profileEnd(std::log(slope), -0.1, quantile, slopeDrop);
        fit.sigma.profile = {m_unit * std::exp(-steepest), m_unit * std::exp(-flattest)};
    }

    Interval thresholdProfile(const std::optional<double>& share, double inside) const
    {
        const auto drop = [&](double at) { return dropAt({Restriction::Kind::Threshold, at, share}, m_best.place); };
        const double step = 0.1 / m_best.place[1];
        return {m_centre + m_unit * profileEnd(inside, -step, m_z * m_z, drop),
                m_centre + m_unit * profileEnd(inside, step, m_z * m_z, drop)};
    }

    const PsychometricLikelihood& m_likelihood;
    const Maximum& m_best;
    double m_centre, m_unit;
    double m_z = 0;
    Matrix m_covariance;
};

double logOfShare(double count, double of) { return count > 0 ? count * std::log(count / of) : 0; }

double logChoose(double n, double k) { return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1); }

void putGoodness(PsychometricFit& fit, double logLikelihood, bool lapseEstimated)
{
    ExactSum saturated, coefficients;
    for (const LevelCounts& one : fit.counts) {
        saturated.add(logOfShare(one.correct, one.trials));
        saturated.add(logOfShare(one.trials - one.correct, one.trials));
        coefficients.add(logChoose(one.trials, one.correct));
    }
    fit.logLikelihood = logLikelihood + coefficients.total();
    fit.deviance = std::max(0.0, 2 * (saturated.total() - logLikelihood));
    const double df = static_cast<double>(fit.levels) - (lapseEstimated ? 3 : 2);
    fit.df = df;
    fit.p = df > 0 ? Value(chiSquaredUpper(*fit.deviance, df).p)
                   : Value::undefined("as many parameters as levels: the fit cannot be tested");
}

PsychometricFit refusedFit(PsychometricFit fit, const std::string& why)
{
    fit.why = why;
    const Value none = Value::undefined(why);
    for (PsychometricEstimate* estimate : {&fit.mu, &fit.sigma, &fit.threshold})
        *estimate = {none, none, {none, none}, {none, none}};
    fit.lapse = fit.seLapse = fit.logLikelihood = fit.deviance = fit.df = fit.p = none;
    return fit;
}

}  // namespace

PsychometricFit fitPsychometricFunction(std::span<const LevelCounts> counts, const PsychometricOptions& options)
{
    PsychometricFit fit;
    if (const std::string fault = faultOfCounts(counts); !fault.empty()) return refusedFit(fit, fault);
    if (const std::string fault = faultOfOptions(options); !fault.empty()) return refusedFit(fit, fault);
    fit.counts = addedUp(counts);
    fit.levels = fit.counts.size();
    for (const LevelCounts& one : fit.counts) fit.trials += one.trials;
    if (const std::string fault = faultOfLevels(fit.counts); !fault.empty()) return refusedFit(fit, fault);

    const double lowest = fit.counts.front().level, highest = fit.counts.back().level;
    const double centre = lowest / 2 + highest / 2, unit = highest / 2 - lowest / 2;
    std::vector<LevelCounts> standardised = fit.counts;
    for (LevelCounts& one : standardised) one.level = (one.level - centre) / unit;
    const PsychometricLikelihood likelihood(std::move(standardised), options);
    const Maximum best = maximised(likelihood);
    if (const std::string fault = faultOfFit(likelihood, best); !fault.empty()) return refusedFit(fit, fault);
    PsychometricReport(likelihood, best, centre, unit).put(fit);
    putGoodness(fit, best.logLikelihood, options.lapse.estimated);
    for (const LevelCounts& one : likelihood.counts()) fit.fitted.push_back(likelihood.probability(best.place, one.level));
    return fit;
}

}  // namespace stats
