#include "database/disk/finger_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace database {

namespace {

using protocols::FingerSample;

constexpr std::int64_t tickNs = 100000;
constexpr std::int64_t farthest = std::int64_t{1} << 40;  ///< of any number in a sound text
constexpr std::int64_t latestNs = std::int64_t{1} << 62;  ///< of any clock; a later time cannot be counted on from

/// A measured value and how many of its unit are written for 1.
struct MeasuredField {
    std::optional<double> FingerSample::*value;
    double perUnit;
};
constexpr std::array<MeasuredField, 3> measuredFields{
    {{&FingerSample::xMm, 100}, {&FingerSample::yMm, 100}, {&FingerSample::forceN, 1000}}};

/// Reads numbers and separators from the front of a text.
class FingerTextReader {
public:
    explicit FingerTextReader(std::string_view text) : m_rest(text) {}

    bool isAtEnd() const { return m_rest.empty(); }
    bool isSound() const { return m_isSound; }

    /// The next character, if it is this one.
    bool takes(char separator)
    {
        if (m_rest.empty() || m_rest.front() != separator) return false;
        m_rest.remove_prefix(1);
        return true;
    }
    void mustTake(char separator) { m_isSound = takes(separator) && m_isSound; }

    std::optional<std::int64_t> number()
    {
        std::int64_t value = 0;
        const auto [end, fault] = std::from_chars(m_rest.data(), m_rest.data() + m_rest.size(), value);
        if (fault == std::errc::invalid_argument) return std::nullopt;  // an empty field
        m_isSound = m_isSound && fault == std::errc() && value >= -farthest && value <= farthest;
        m_rest.remove_prefix(static_cast<std::size_t>(end - m_rest.data()));
        return m_isSound ? std::optional(value) : std::nullopt;
    }

private:
    std::string_view m_rest;
    bool m_isSound = true;
};

/// The values so far, in the units of the text.
struct FingerSums {
    std::int64_t ticks = 0;
    std::array<std::int64_t, measuredFields.size()> values{};

    bool areSound() const
    {
        for (const std::int64_t value : values)
            if (value < -farthest || value > farthest) return false;
        return ticks >= 0 && ticks <= farthest;
    }
};

FingerSample nextSample(FingerTextReader& reader, FingerSums& sums, std::int64_t beganAtNs)
{
    FingerSample sample;
    const auto later = reader.number();
    sums.ticks += later && *later >= 0 ? *later : -2 * farthest;  // no sample is without a time, or before the one before
    for (std::size_t field = 0; field < measuredFields.size() && reader.isSound(); ++field) {
        reader.mustTake(',');
        const auto change = reader.number();
        if (!change) continue;
        sums.values[field] += *change;
        sample.*measuredFields[field].value = static_cast<double>(sums.values[field]) / measuredFields[field].perUnit;
    }
    sample.atNs = beganAtNs + sums.ticks * tickNs;
    return sample;
}

}  // namespace

std::string fingerTextOf(std::span<const FingerSample> samples)
{
    std::string text;
    FingerSums before;
    for (const FingerSample& sample : samples) {
        const std::int64_t ticks = (sample.atNs - samples.front().atNs) / tickNs;
        if (!text.empty()) text += ';';
        text += std::to_string(ticks - before.ticks);
        before.ticks = ticks;
        for (std::size_t field = 0; field < measuredFields.size(); ++field) {
            text += ',';
            const std::optional<double>& value = sample.*measuredFields[field].value;
            if (!value) continue;
            const auto now = static_cast<std::int64_t>(std::llround(*value * measuredFields[field].perUnit));
            text += std::to_string(now - before.values[field]);
            before.values[field] = now;
        }
    }
    return text;
}

std::optional<std::vector<FingerSample>> fingerSamplesFrom(std::string_view text, std::int64_t beganAtNs)
{
    if (beganAtNs < -latestNs || beganAtNs > latestNs) return std::nullopt;
    std::vector<FingerSample> samples;
    FingerTextReader reader(text);
    FingerSums sums;
    while (!reader.isAtEnd()) {
        if (!samples.empty()) reader.mustTake(';');
        samples.push_back(nextSample(reader, sums, beganAtNs));
        if (!reader.isSound() || !sums.areSound() || samples.front().atNs != beganAtNs) return std::nullopt;
    }
    return samples;
}

}  // namespace database
