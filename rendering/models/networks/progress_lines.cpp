#include "rendering/models/networks/progress_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace rendering::models {

namespace {

std::string minutes(double seconds)
{
    const int whole = std::max(0, static_cast<int>(std::lround(seconds)));
    char text[32];
    std::snprintf(text, sizeof text, "%d:%02d", whole / 60, whole % 60);
    return text;
}

/// Number rounded to three decimals, with a decimal point in every locale.
std::string figure(double value) { return nlohmann::json(std::round(value * 1000) / 1000).dump(); }

}  // namespace

bool StepLosses::finite() const { return std::isfinite(discriminator) && std::isfinite(generators) && std::isfinite(distance); }

void ProgressLines::print(const std::string& line)
{
    if (m_barShown) m_out << '\n';
    m_barShown = false;
    m_out << line << std::endl;
}

void ProgressLines::reading(int done, int total)
{
    if (m_terminal && done % 16 == 0)
        bar(static_cast<double>(done) / std::max(1, total), "reading the data set");
    else if (!m_terminal && done == 0)
        print("reading " + std::to_string(total) + " files");
}

void ProgressLines::step(int number, double fraction, const StepLosses& losses, double remainingS)
{
    const double keep = m_started ? 0.95 : 0;
    m_started = true;
    m_smooth.discriminator = keep * m_smooth.discriminator + (1 - keep) * losses.discriminator;
    m_smooth.generators = keep * m_smooth.generators + (1 - keep) * losses.generators;
    m_smooth.distance = keep * m_smooth.distance + (1 - keep) * losses.distance;
    const std::string text = "step " + std::to_string(number) + "  D " + figure(m_smooth.discriminator) + "  G " +
                             figure(m_smooth.generators) + "  distance " + figure(m_smooth.distance) + "  " +
                             minutes(remainingS) + " left";
    const auto now = std::chrono::steady_clock::now();
    if (m_terminal) {
        bar(fraction, text);
    } else if (fraction >= 1 || now - m_lastLine > std::chrono::seconds(10)) {
        print(text);
        m_lastLine = now;
    }
}

void ProgressLines::validated(int number, const nlohmann::ordered_json& figures, bool better)
{
    if (figures.is_null()) return;
    std::string text = "validation at step " + std::to_string(number) + (better ? " (best so far)" : "") + ":";
    for (const auto& [name, value] : figures.items())
        if (value.is_object()) text += " " + name + " " + figure(value.at("generated").get<double>());
    print(text);
}

void ProgressLines::finished(const ModelCardFields& card)
{
    print("trained " + std::to_string(card.steps) + " steps in " + figure(card.trainingMinutes) + " min");
    const auto validation = nlohmann::ordered_json::parse(card.validationJson);
    if (!validation.at("after").is_null())
        print("validation before " + validation.at("before").dump() + " after " + validation.at("after").dump());
}

void ProgressLines::bar(double fraction, const std::string& text)
{
    constexpr int width = 24;
    const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width);
    m_out << '\r' << '[' << std::string(static_cast<std::size_t>(filled), '#')
          << std::string(static_cast<std::size_t>(width - filled), '.') << "] " << text << "\x1b[K" << std::flush;
    m_barShown = true;
}

}  // namespace rendering::models
