#include "reports/page/signal_text.h"

#include <cmath>

#include "protocols/files/markup_text.h"
#include "reports/page/html_parts.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

constexpr SignalMeasure registered = SignalMeasure::HeightSsimRegistered;

NumberTile signalTile(const stats::Value& value, double factor, int decimals, const std::string& unit, const std::string& what)
{
    if (!value.exists()) return {"\u2013", what + ": " + value.why()};
    return {fixed(*value * factor, decimals) + unit, what};
}

stats::Value generatedValue(const SignalComparison& signals, SignalMeasure measure)
{
    return signals.controls ? signals.controls->generated.mean[measure] : stats::Value::undefined(signals.whyNoControls);
}

std::string signalTiles(const SignalComparison& signals)
{
    return tiles(
        {signalTile(generatedValue(signals, registered), 1, 3, "", "registered SSIM of the height maps"),
         signalTile(generatedValue(signals, SignalMeasure::HeightSpectrum), 1, 2, " dB", "distance of the height spectra"),
         signalTile(signals.frictionMae, 1, 4, "", "mean absolute error of the friction coefficient"),
         signalTile(signals.frictionMaeOverMean, 100, 1, " %", "of the mean measured friction"),
         signalTile(signals.heightSsim, 1, 3, "", "plain SSIM of the height maps, without registration"),
         signalTile(signals.heightRangeMm, 1, 3, " mm", "range of the measured maps (L of SSIM)")});
}

/// "0.49, 95 % CI [0.40, 0.58]"; the size of the difference without its sign if `size`.
std::string differenceText(const SignalDifference& difference, bool size)
{
    const double sign = size && *difference.meanDifference < 0 ? -1 : 1;
    std::string text = typeset(fixed(sign * *difference.meanDifference, 3));
    if (!difference.ci95.low.exists() || !difference.ci95.high.exists()) return text;
    const double low = *difference.ci95.low, high = *difference.ci95.high;
    return text + ", 95 % CI [" + typeset(fixed(sign > 0 ? low : -high, 3)) + ", " + typeset(fixed(sign > 0 ? high : -low, 3)) +
           "]";
}

std::string verdictText(const SignalSource& control)
{
    if (!control.whyUnfair.empty())
        return "It is not a fair control, because it was " + protocols::escapedMarkup(control.whyUnfair) +
               ". No difference is stated.";
    const auto found = control.differences.find(registered);
    if (found == control.differences.end() || !found->second.meanDifference.exists()) return {};
    const SignalDifference& difference = found->second;
    if (!difference.p.exists())
        return "The difference is " + differenceText(difference, false) +
               ". It has no test: " + protocols::escapedMarkup(difference.p.why()) + ".";
    const std::string word = wordFor(registered, difference);
    if (word == "not decided")
        return "Whether the generated maps differ is not decided: " + differenceText(difference, false) + ".";
    return "The generated maps are " + word + " by " + differenceText(difference, true) + ".";
}

std::string controlLine(const SignalSource& control)
{
    const stats::Value& value = control.mean[registered];
    const std::string name = "<b>" + protocols::escapedMarkup(control.name) + "</b>: ";
    if (!value.exists()) return name + "\u2013 (" + protocols::escapedMarkup(value.why()) + ")";
    return name + fixed(*value, 3) + ". " + verdictText(control);
}

std::size_t fabricsWith(const SignalSource& source, SignalMeasure measure)
{
    std::size_t n = 0;
    for (const FabricSignalValues& fabric : source.fabrics) n += fabric.values[measure].exists() ? 1 : 0;
    return n;
}

std::string headline(const SignalControls& controls)
{
    const stats::Value& value = controls.generated.mean[registered];
    if (!value.exists()) return {};
    std::vector<std::string> lines;
    for (const SignalSource& control : controls.controls) lines.push_back(controlLine(control));
    return paragraph("<b>Registered SSIM of the generated height maps is " + fixed(*value, 3) + "</b>, the mean over " +
                     counted(fabricsWith(controls.generated, registered), "fabric") +
                     ". Before the comparison, both maps are rotated to the axes of the fabric and shifted for the best fit. The "
                     "same measure of the controls:") +
           bulletList(lines) +
           paragraph(
               "&ldquo;Better&rdquo; and &ldquo;worse&rdquo; mean p &lt; .05 of a paired t test over the fabrics, after "
               "Holm's correction over the controls. The intervals are not corrected.");
}

const SignalSource* controlNamed(const SignalControls& controls, const std::string& id)
{
    for (const SignalSource& control : controls.controls)
        if (control.id == id) return &control;
    return nullptr;
}

std::string pairsText(const SignalControls& controls)
{
    if (controls.pairing == "aligned")
        return paragraph(
            "The pairs are aligned: photograph and press show the same place. Plain SSIM then also measures whether "
            "every wave lies at its place.");
    std::string text =
        "The pairs are weak: photograph and press show different places of a fabric. Plain SSIM compares the maps "
        "pixel by pixel, so the right texture at another place counts as an error.";
    const SignalSource* flat = controlNamed(controls, "fabric_mean");
    const stats::Value& generated = controls.generated.mean[SignalMeasure::HeightSsim];
    if (flat != nullptr && flat->mean[SignalMeasure::HeightSsim].exists() && generated.exists())
        text += " Here a flat map at the fabric's mean height has a plain SSIM of " +
                fixed(*flat->mean[SignalMeasure::HeightSsim], 3) + ", the generated maps have " + fixed(*generated, 3) + ".";
    return paragraph(text);
}

std::string notesText(const SignalControls& controls)
{
    std::string text = "The controls know " + counted(controls.photographs, "photograph") + ", " +
                       std::to_string(controls.presses) + (controls.presses == 1 ? " press and " : " presses and ") +
                       counted(controls.strokes, "stroke") +
                       " of the training part of the data set. The study shows none of them.";
    for (const std::string& note : controls.notes) text += " " + protocols::escapedMarkup(note);
    return paragraph(text);
}

}  // namespace

std::string signalsLead(const StudyData& data)
{
    if (!data.signals) return {};
    const SignalComparison& signals = *data.signals;
    std::string text = signalTiles(signals);
    if (signals.controls)
        text += headline(*signals.controls) + pairsText(*signals.controls) + notesText(*signals.controls);
    else
        text += paragraph("Controls are missing: " + protocols::escapedMarkup(signals.whyNoControls) + ".");
    return text +
           paragraph(
               "The t test asks whether the averages differ, and a small p shows that they do. The equivalence test beside "
               "it asks whether generated and measured averages are close.");
}

}  // namespace reports
