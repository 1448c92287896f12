#include "reports/tables/report_tables.h"

#include "reports/write_report.h"
#include "stats/power/measured_size.h"

namespace reports {
namespace {

std::string participantsOf(const Json& results) { return std::to_string(countOf(results["study"], "participants")); }

/// What a reader of a mixed model must know beside its test.
std::string noteOn(const Json& model)
{
    if (model.value("warn", false)) return "separation: " + model.value("separation", std::string());
    if (model.value("singular", false)) return "singular: a random effect was estimated as zero";
    return model.contains("left_out") ? "without random effects that cannot be estimated" : "new participants and fabrics";
}

}  // namespace

Table overviewTable(const Json& results)
{
    Table table{"overview", "Matches per rendering, and ratings as mean \u00B1 SD over ratings", {"condition"}, {}};
    for (const std::string& question : choiceQuestions(results)) {
        table.columns.emplace_back(question + " matches of " + participantsOf(results));
        table.columns.emplace_back(question + " correct");
    }
    for (const std::string& question : ratingQuestions(results)) {
        table.columns.emplace_back(question);
        table.columns.emplace_back(question + " sd", Shown::InCsv);
    }
    for (const std::string& condition : conditionsOf(results)) {
        std::vector<TableCell> row{conditionCell(condition)};
        for (const std::string& question : choiceQuestions(results)) {
            const Json& part = results[question][condition];
            row.push_back(numberCell(valueOf(part, "matches_per_rendering"), 1));
            TableCell counts = textCell(std::to_string(countOf(part, "correct")) + "/" + std::to_string(countOf(part, "trials")));
            counts.isNumber = true;
            row.push_back(counts);
        }
        for (const std::string& question : ratingQuestions(results)) {
            const Json& part = results[question][condition];
            row.push_back(meanSdCell(valueOf(part, "mean"), valueOf(part, "sd"), 1));
            row.push_back(numberCell(valueOf(part, "sd"), 1));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table matchesTable(const Analysis& analysis, const std::string& question)
{
    const Json& results = analysis.results;
    Table table{lowerCase(question) + "_matches",
                question + ": correct matches, their share with Wilson's 95 % interval, and the tests against chance 1/" +
                    std::to_string(analysis.data.alternativesOf(question)),
                {"condition",
                 "matches of " + participantsOf(results),
                 "correct",
                 "trials",
                 "share",
                 {"95 % CI low", Shown::InCsv},
                 {"95 % CI high", Shown::InCsv},
                 {"95 % CI", Shown::InDocuments},
                 "p chance, trials",
                 "p chance (Holm)",
                 "p chance, participants"},
                {}};
    const Json& rows = analysis.statistics[lowerCase(question) + "_per_condition"];
    const auto conditions = conditionsOf(results);
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        const Json& part = results[question][conditions[i]];
        const stats::Interval ci = intervalOf(part, "ci95");
        table.rows.push_back({conditionCell(conditions[i]), numberCell(valueOf(part, "matches_per_rendering"), 1),
                              countCell(countOf(part, "correct")), countCell(countOf(part, "trials")),
                              numberCell(valueOf(part, "proportion"), 2), numberCell(ci.low, 2), numberCell(ci.high, 2),
                              intervalCell(ci, 2), pCell(valueOf(part, "p_chance")), pCell(valueOf(rows[i], "p_holm")),
                              pCell(valueOf(part, "p_chance_participants"))});
    }
    return table;
}

Table matchesByFabricTable(const Analysis& analysis, const std::string& question)
{
    Table table{lowerCase(question) + "_matches_by_fabric",
                question + ": participants who matched each rendering with its fabric",
                {"condition"},
                {}};
    const Json& part = analysis.statistics[lowerCase(question) + "_matches_by_rendering"];
    for (const std::string& fabric : analysis.data.fabrics) table.columns.emplace_back(fabric);
    for (const std::string& condition : analysis.data.conditions) {
        std::vector<TableCell> row{conditionCell(condition)};
        for (const std::string& fabric : analysis.data.fabrics)
            row.push_back(countCell(countOf(part[condition][fabric], "correct")));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table ratingsTable(const Analysis& analysis, const std::string& question)
{
    Table table{lowerCase(question) + "_ratings",
                question + ": ratings, with the 95 % interval of the participants' means",
                {"condition",
                 "ratings",
                 "mean \u00B1 SD",
                 {"sd", Shown::InCsv},
                 "participants",
                 {"95 % CI low", Shown::InCsv},
                 {"95 % CI high", Shown::InCsv},
                 {"95 % CI", Shown::InDocuments},
                 "within-subject half-width"},
                {}};
    for (const std::string& condition : conditionsOf(analysis.results)) {
        const Json& part = analysis.results[question][condition];
        const stats::Interval ci = intervalOf(part, "ci95");
        table.rows.push_back({conditionCell(condition), countCell(countOf(part, "n")),
                              meanSdCell(valueOf(part, "mean"), valueOf(part, "sd"), 2), numberCell(valueOf(part, "sd"), 2),
                              countCell(countOf(part, "participants")), numberCell(ci.low, 2), numberCell(ci.high, 2),
                              intervalCell(ci, 2),
                              numberCell(valueOf(analysis.statistics[question]["morey95_halfwidth"], condition), 2)});
    }
    return table;
}

Table omnibusTable(const Analysis& analysis)
{
    Table table{"all_conditions",
                "All conditions at once: on the participants' means (complete blocks), and by mixed models of every answer",
                {"question", "test", "n", "statistic", "df", "p", "p (Greenhouse-Geisser)", "effect"},
                {}};
    const auto dfText = [](const Json& part, const char* a, const char* b) {
        const stats::Value first = valueOf(part, a);
        const stats::Value second = valueOf(part, b);
        TableCell cell = textCell(first.exists() && second.exists() ? fixed(*first, 0) + ", " + fixed(*second, 0) : "-");
        cell.isNumber = true;
        return cell;
    };
    for (const std::string& question : choiceQuestions(analysis.results)) {
        const Json& part = analysis.statistics[lowerCase(question) + "_cochran"];
        table.rows.push_back({textCell(question), textCell("Cochran's\u00A0Q"), countCell(countOf(part, "blocks")),
                              numberCell(valueOf(part, "Q"), 2), numberCell(valueOf(part, "df"), 0), pCell(valueOf(part, "p")),
                              blankCell(), textCell("descriptive: ignores clustering")});
        const Json& model = analysis.statistics[lowerCase(question) + "_glmm"];
        table.rows.push_back({textCell(question), textCell("logistic mixed model \u03c7\u00b2"),
                              countCell(countOf(model, "rows")), numberCell(valueOf(model, "lrt_chi2"), 2),
                              numberCell(valueOf(model, "lrt_df"), 0), pCell(valueOf(model, "lrt_p")), blankCell(),
                              textCell(noteOn(model))});
    }
    for (const std::string& question : ratingQuestions(analysis.results)) {
        const Json& anova = analysis.statistics[question]["rm_anova"];
        const Json& friedman = analysis.statistics[question]["friedman"];
        const stats::Value pes = valueOf(anova, "pes");
        const stats::Value w = valueOf(friedman, "kendall_w");
        table.rows.push_back({textCell(question), textCell("RM-ANOVA\u00A0F"), countCell(countOf(anova, "n")),
                              numberCell(valueOf(anova, "F"), 2), dfText(anova, "df1", "df2"), pCell(valueOf(anova, "p")),
                              pCell(valueOf(anova, "p_gg")),
                              textCell(pes.exists() ? "partial eta squared " + fixed(*pes, 2) : pes.why())});
        table.rows.push_back({textCell(question), textCell("Friedman\u00A0Q"), countCell(countOf(friedman, "n")),
                              numberCell(valueOf(friedman, "Q"), 2), numberCell(valueOf(friedman, "df"), 0),
                              pCell(valueOf(friedman, "p")), blankCell(),
                              textCell(w.exists() ? "Kendall's W " + fixed(*w, 2) : w.why())});
        const Json& model = analysis.statistics[question]["lmm"];
        table.rows.push_back({textCell(question), textCell("mixed model\u00A0F"), countCell(countOf(model, "rows")),
                              numberCell(valueOf(model, "F"), 2), dfText(model, "num_df", "den_df"), pCell(valueOf(model, "p")),
                              blankCell(), textCell(noteOn(model))});
    }
    return table;
}

Table screeningTable(const Analysis& analysis)
{
    const Json& screening = analysis.statistics["screening"];
    Table table{"screening", "", {"question", "condition", "before", "after", "difference"}, {}};
    std::string names;
    for (const Json& one : screening["excluded"]) names += (names.empty() ? "" : ", ") + one["participant"].get<std::string>();
    table.caption =
        "Means of the participants' means, all of them and without the flagged ones (" + names + "); every other table has all";
    if (!screening["questions"].is_object()) return table;
    for (const auto& [question, conditions] : screening["questions"].items())
        for (const auto& [condition, row] : conditions.items()) {
            const stats::Value before = valueOf(row, "before"), after = valueOf(row, "after");
            const bool both = before.exists() && after.exists();
            table.rows.push_back({textCell(question), conditionCell(condition), numberCell(before, 2), numberCell(after, 2),
                                  both ? numberCell(*after - *before, 2) : blankCell()});
        }
    return table;
}

Table measuredSizesTable()
{
    Table table{"measured_sizes",
                "How often each test rejected at 5 % in " + std::to_string(stats::measuredStudies) +
                    " simulated studies of the paper's size without anything to find",
                {"test", "what was simulated", "rejected %", "attainable %", "remark"},
                {}};
    for (const stats::MeasuredSize& size : stats::measuredSizes()) {
        const bool isExact = size.attainableSize > 0;
        table.rows.push_back(
            {textCell(std::string(size.test)), textCell(std::string(size.truth)),
             numberCell(static_cast<double>(size.rejected) * 100 / static_cast<double>(stats::measuredStudies), 2),
             isExact ? numberCell(100 * size.attainableSize, 2) : blankCell(),
             size.antiConservative() ? textCell("anti-conservative") : blankCell()});
    }
    return table;
}

Table speedTable(const Analysis& analysis)
{
    Table table{"speed_accuracy",
                "Speed and accuracy of the matching task by condition",
                {"condition", "median s", "bits per second", "balanced integration score"},
                {}};
    for (const std::string& condition : conditionsOf(analysis.results)) {
        const Json& part = analysis.results["speed_accuracy"][condition];
        table.rows.push_back({conditionCell(condition), numberCell(valueOf(part, "median_seconds"), 1),
                              numberCell(valueOf(part, "bits_per_second"), 3), numberCell(valueOf(part, "bis"), 2)});
    }
    return table;
}

Table signalsTable(const Json& signals)
{
    Table table{"signals_t_tests",
                "Generated minus measured signals, one mean difference a fabric",
                {"signal",
                 {"unit", Shown::InCsv},
                 "n",
                 "mean difference",
                 "95 % CI",
                 "t",
                 "df",
                 "p (difference)",
                 "bounds",
                 "p (TOST)",
                 "verdict"},
                {}};
    for (const Json& row : signals.value("t_tests", Json::array())) {
        const Json tost = row.value("tost", Json::object());
        const stats::Value p = valueOf(row, "p");
        const stats::Value pTost = valueOf(tost, "p");
        const bool defined = p.exists() && pTost.exists();
        const std::string verdict = defined ? std::string(*p < 0.05 ? "different" : "not different") +
                                                  (*pTost < 0.05 ? " / equivalent" : " / not shown equivalent")
                                            : "undefined";
        table.rows.push_back({textCell(row.value("signal", "")), textCell(row.value("unit", "")), countCell(countOf(row, "n")),
                              numberCell(valueOf(row, "mean_difference"), 4), intervalCell(intervalOf(row, "ci95"), 4),
                              numberCell(valueOf(row, "statistic"), 2), numberCell(valueOf(row, "df"), 0), pCell(p),
                              intervalCell(intervalOf(tost, "bounds"), 4), pCell(pTost), textCell(verdict)});
    }
    return table;
}

Table qualityTable(const Json& results)
{
    Table table{"quality", "Flags on the data", {"participant", "flag", "why"}, {}};
    for (const Json& row : results["quality"])
        table.rows.push_back({textCell(row["participant"].is_null() ? "all" : row["participant"].get<std::string>()),
                              textCell(row["flag"]), textCell(row["why"])});
    return table;
}

Table missingTable(const Analysis& analysis)
{
    Table table{"missing", "Missing answers by condition", {"condition"}, {}};
    const Json& missing = analysis.statistics["data"]["missing_by_condition"];
    for (const QuestionInfo& question : analysis.data.questions) table.columns.emplace_back(question.id);
    for (const std::string& condition : analysis.data.conditions) {
        std::vector<TableCell> row{conditionCell(condition)};
        for (const QuestionInfo& question : analysis.data.questions)
            row.push_back(countCell(countOf(missing[question.id], condition)));
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::vector<Table> allTables(const Analysis& analysis)
{
    const Json& results = analysis.results;
    std::vector<Table> tables{overviewTable(results)};
    for (const std::string& question : choiceQuestions(results)) {
        tables.push_back(matchesTable(analysis, question));
        tables.push_back(matchesByFabricTable(analysis, question));
    }
    for (const std::string& question : ratingQuestions(results)) tables.push_back(ratingsTable(analysis, question));
    tables.push_back(omnibusTable(analysis));
    if (hasPlanned(results)) {
        tables.push_back(plannedComparisonsTable(results));
        tables.push_back(plannedEquivalenceTable(results));
    }
    for (const QuestionInfo& question : analysis.data.questions) tables.push_back(comparisonsTable(results, question.id));
    for (const std::string& question : ratingQuestions(results)) tables.push_back(equivalenceTable(results, question));
    tables.push_back(speedTable(analysis));
    tables.push_back(measuredSizesTable());
    if (const Table screening = screeningTable(analysis); !screening.rows.empty()) tables.push_back(screening);
    if (results["signals"].is_object()) tables.push_back(signalsTable(results["signals"]));
    tables.push_back(qualityTable(results));
    tables.push_back(missingTable(analysis));
    return tables;
}

std::string resultTable(const nlohmann::ordered_json& results) { return toText(overviewTable(results)); }

}  // namespace reports
