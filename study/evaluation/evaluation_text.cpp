#include "study/evaluation/evaluation_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "study/evaluation/criteria.h"

namespace study::evaluation {

namespace {

using Line = std::vector<std::string>;

std::string number(const char* format, double value)
{
    char text[40];
    std::snprintf(text, sizeof text, format, value);  // commands run in the "C" locale, never in that of a window
    return text;
}

/// Table with columns as wide as their widest entry. The first column is aligned left, the others right.
std::string table(const std::vector<Line>& lines)
{
    std::vector<std::size_t> widths;
    for (const Line& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (i == widths.size()) widths.push_back(0);
            widths[i] = std::max(widths[i], line[i].size());
        }
    std::string text;
    for (const Line& line : lines) {
        std::string row = "  ";
        for (std::size_t i = 0; i < line.size(); ++i) {
            const std::string gap(widths[i] - line[i].size(), ' ');
            row += i == 0 ? line[i] + gap : "  " + gap + line[i];
        }
        row.erase(row.find_last_not_of(' ') + 1);
        text += row + "\n";
    }
    return text;
}

std::string countOf(int count, const std::string& noun) { return std::to_string(count) + " " + noun + (count == 1 ? "" : "s"); }

std::string splitName(const Evaluation& evaluation)
{
    return "by " + std::string(nameOf(evaluation.split)) + ", " + (evaluation.aligned ? "aligned pairs" : "weak pairs");
}

std::string title(const Evaluation& evaluation, const std::string& what)
{
    return "\n" + what + " (" + splitName(evaluation) + ")\n";
}

struct TitledSection {
    Section section;
    const char* title;
};

constexpr TitledSection sections[] = {
    {Section::Friction, "Friction"},
    {Section::Height, "Height"},
    {Section::Roughness, "Roughness, generated divided by measured: 1 means equal"},
    {Section::Identification, "Fabrics recognised from their signals"},
};

bool hasAny(const PredictorResult& predictor, Section section)
{
    return std::any_of(measureTable().begin(), measureTable().end(),
                       [&](const MeasureRow& row) { return row.section == section && at(predictor.mean, row.measure).exists(); });
}

/// The 95 % intervals of a model's means, below them.
Line intervalLine(const PredictorResult& predictor, Section section)
{
    Line line{"  95 % interval over fabrics"};
    for (const MeasureRow& row : measureTable())
        if (row.section == section) {
            const stats::Interval& interval = at(predictor.ci95, row.measure);
            line.push_back(interval.low.exists() && interval.high.exists()
                               ? formatted(interval.low, row.format) + " to " + formatted(interval.high, row.format)
                               : "-");
        }
    return line;
}

/// Table of one section with one row for each predictor. The reasons for missing values follow below.
std::string sectionTable(const Evaluation& evaluation, const TitledSection& section)
{
    std::vector<Line> lines{{""}};
    std::string meanings;
    std::set<std::string> reasons;
    for (const MeasureRow& row : measureTable())
        if (row.section == section.section) {
            lines.front().push_back(std::string(row.heading));
            meanings += "    " + std::string(row.heading) + ": " + std::string(row.meaning) + "\n";
        }
    for (const PredictorResult& predictor : evaluation.predictors) {
        const bool measured = predictor.predictor.kind == PredictorKind::Measured;
        if (measured && section.section != Section::Identification) continue;
        Line line{predictor.predictor.name};
        for (const MeasureRow& row : measureTable())
            if (row.section == section.section) {
                const stats::Value& value = at(predictor.mean, row.measure);
                line.push_back(formatted(value, row.format));
                if (!value.exists()) reasons.insert(value.why());
            }
        lines.push_back(line);
        if (predictor.predictor.kind == PredictorKind::Generated || predictor.predictor.kind == PredictorKind::Against)
            lines.push_back(intervalLine(predictor, section.section));
    }
    std::string text = title(evaluation, section.title) + table(lines) + meanings;
    for (const std::string& reason : reasons) text += "    -: " + reason + "\n";
    return text;
}

std::string formattedP(const stats::Value& p)
{
    return p.exists() && *p < 1e-4 ? "< 0.0001" : formatted(p, NumberFormat::Plain4);
}

std::string meansTable(const Evaluation& evaluation)
{
    const int percent = static_cast<int>(std::lround(100 * evaluation.boundsFraction));
    std::string text = title(evaluation, "Do the means over fabrics equal the measured means? Unit: fabric");
    std::vector<Line> lines{{"", "mean friction", "difference", "p (equal)  ", "p (different)", "Sq, mm", "difference",
                             "p (equal)  ", "p (different)"}};
    for (const PredictorResult& predictor : evaluation.predictors) {
        Line line{predictor.predictor.name};
        const auto add = [&](Measure measure, const MeanComparison& means) {
            line.push_back(formatted(at(predictor.mean, measure), NumberFormat::Plain4));
            if (predictor.predictor.kind == PredictorKind::Measured) {
                line.insert(line.end(), {"", "", ""});
                return;
            }
            line.push_back(formatted(means.equivalence.estimate, NumberFormat::Plain4));
            line.push_back(formattedP(means.equivalence.p) + (means.equivalence.equivalent ? " *" : "  "));
            line.push_back(formattedP(means.equivalence.pDifference));
        };
        add(Measure::MeanFriction, predictor.friction);
        add(Measure::SqMm, predictor.sq);
        lines.push_back(line);
    }
    text += table(lines);
    text += "    p (equal): two one-sided tests against bounds of +-" + std::to_string(percent) +
            " % of the measured mean; * marks means that are equal within these bounds (p < 0.05)\n"
            "    p (different): the paper's paired t test; a large p does not show that the means are equal\n";
    return text;
}

/// Table of the criteria: verdict, measure, requirement and result, all aligned left.
std::string criteriaTable(const Evaluation& evaluation)
{
    const auto criteria = criteriaOf(evaluation);
    if (criteria.empty()) return {};
    std::size_t what = 0, required = 0;
    for (const Criterion& one : criteria) {
        what = std::max(what, one.what.size());
        required = std::max(required, one.required.size());
    }
    std::string text = title(evaluation, "Criteria for the generated signals");
    const auto padded = [](std::string entry, std::size_t width) {
        entry.resize(std::max(width, entry.size()), ' ');
        return entry + "  ";
    };
    for (const Criterion& one : criteria)
        text += "  " + padded(one.reached ? (*one.reached ? "yes" : "NO") : "?", 3) + padded(one.what, what) +
                padded(one.required, required) + one.found + "\n";
    return text;
}

int sumOf(const std::map<Modality, int>& counts)
{
    int sum = 0;
    for (const auto& [modality, count] : counts) sum += count;
    return sum;
}

std::string bySignal(const std::map<Modality, int>& counts)
{
    const auto count = [&](Modality modality) { return counts.contains(modality) ? counts.at(modality) : 0; };
    return countOf(count(Modality::Visual), "photograph") + ", " + std::to_string(count(Modality::Tactile)) +
           (count(Modality::Tactile) == 1 ? " press, " : " presses, ") + countOf(count(Modality::Friction), "stroke");
}

std::string leaksText(const Leaks& leaks, SplitKind split)
{
    std::string text = "  testing part: " + bySignal(leaks.tested) + "\n";
    const auto add = [&](const std::map<Modality, int>& counts, const std::string& what) {
        text += "  " + what + ": " + (sumOf(counts) == 0 ? "none" : bySignal(counts)) + "\n";
    };
    const bool leak = split == SplitKind::Augmented;
    add(leaks.trainedOn, leak ? "  LEAK: a model was trained on these files; the figures below also measure memory"
                              : "  left out because a model was trained on these files");
    if (sumOf(leaks.placeTrainedOn) > 0)
        add(leaks.placeTrainedOn, "  left out because a model was trained on the same place of the fabric");
    add(leaks.duplicates, "  identical with a sample outside the testing part");
    add(leaks.overlaps, "  at the same place of the fabric as a sample of this signal outside the testing part");
    return text;
}

std::string head(const Evaluation& evaluation)
{
    const ModelUsed& model = evaluation.models.front();
    std::string text = "Generated against measured signals: model \"" + model.name + "\" on \"" + evaluation.dataset + "\"\n";
    text += "  split " + splitName(evaluation) + ", seed " + std::to_string(evaluation.splitSeed) + ": " +
            countOf(evaluation.pairs, "test photograph") + " of " + countOf(evaluation.fabrics, "fabric") +
            (evaluation.aligned ? ", each compared with the press and the stroke of its index\n"
                                : ", each compared with a press and a stroke of its fabric, drawn by seed\n");
    text += "  the controls use " + countOf(evaluation.trainingPhotographs, "photograph") + ", " +
            std::to_string(evaluation.trainingPresses) + " presses and " + countOf(evaluation.trainingStrokes, "stroke") +
            " of the training part\n";
    text += "  figures are means within a fabric, then over fabrics";
    if (evaluation.rangeMm.exists())
        text += "; SSIM: L = " + number("%.4f", *evaluation.rangeMm) + " mm, the range of all measured test maps";
    text += "\n" + leaksText(evaluation.leaks, evaluation.split);
    for (const std::string& note : evaluation.notes) text += "  note: " + note + "\n";
    return text;
}

}  // namespace

std::string formatted(const stats::Value& value, NumberFormat format)
{
    if (!value.exists()) return "-";
    switch (format) {
        case NumberFormat::Plain4:
            return number("%.4f", *value);
        case NumberFormat::Percent:
            return number("%.1f %%", 100 * *value);
        case NumberFormat::Decibels:
            return number("%.2f dB", *value);
        case NumberFormat::Ratio:
            return number("%.3f", *value);
    }
    return {};
}

std::string evaluationText(const Evaluation& evaluation)
{
    std::string text = head(evaluation);
    for (const TitledSection& section : sections) {
        const bool any = std::any_of(evaluation.predictors.begin(), evaluation.predictors.end(),
                                     [&](const PredictorResult& predictor) { return hasAny(predictor, section.section); });
        if (any) text += sectionTable(evaluation, section);
        if (section.section == Section::Friction && evaluation.noiseFloor.exists())
            text += "    noise floor of MAE/mean: " + formatted(evaluation.noiseFloor, NumberFormat::Percent) +
                    ", the error of a constant at the true mean of each stroke\n";
        if (!any)
            for (const MeasureRow& row : measureTable())
                if (row.section == section.section) {
                    text += title(evaluation, section.title) +
                            "  not measured: " + at(evaluation.predictors.front().mean, row.measure).why() + "\n";
                    break;
                }
    }
    return text + meansTable(evaluation) + criteriaTable(evaluation);
}

}  // namespace study::evaluation
