#include "study/simulation/simulation_files.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/whole_file.h"
#include "reports/formats/table_cells.h"
#include "reports/formats/table_formats.h"
#include "reports/formats/tex_table.h"
#include "reports/json/results_json.h"
#include "reports/tables/pair_tables.h"
#include "reports/tables/rating_tables.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace study::simulation {

namespace {

namespace fs = std::filesystem;
using namespace reports;

Table matchesTable(const StudyAnalysis& analysis, const AnalysedQuestion<ChoiceAnalysis>& question)
{
    Table table{
        lowerCase(question.id()) + "_matches",
        question.id() + ": correct matches. Wilson's interval takes trials as independent; the test of participants does not",
        {"condition",
         "correct",
         "trials",
         "share",
         {"95 % CI low", ColumnUse::InCsv},
         {"95 % CI high", ColumnUse::InCsv},
         {"95 % CI, trials as independent", ColumnUse::InDocuments},
         "p chance, trials",
         "p chance (Holm)",
         "participants",
         "mean share",
         {"95 % CI low, participants", ColumnUse::InCsv},
         {"95 % CI high, participants", ColumnUse::InCsv},
         {"95 % CI, participants", ColumnUse::InDocuments},
         "p chance, participants",
         "d\u2032"},
        {}};
    for (std::size_t c = 0; c < analysis.data.conditions.size(); ++c) {
        const ConditionChoices& choices = question.findings.conditions[c];
        const stats::TTest& test = choices.participantsAgainstChance;
        const stats::Interval& wilson = choices.againstChance.wilson;
        table.rows.push_back(
            {conditionCell(analysis.data.conditions[c]), countCell(choices.count.correct), countCell(choices.count.trials),
             numberCell(choices.againstChance.estimate, 3), numberCell(wilson.low, 3), numberCell(wilson.high, 3),
             intervalCell(wilson, 3), pCell(choices.againstChance.pGreater, choices.againstChance.logPGreater),
             pCell(choices.pHolm), countCell(test.n), numberCell(test.estimate, 3), numberCell(test.ci.low, 3),
             numberCell(test.ci.high, 3), intervalCell(test.ci, 3), pCell(test.p, test.logP), numberCell(choices.dPrime, 2)});
    }
    return table;
}

/// One row a test of all conditions.
Table omnibusTable(const StudyAnalysis& analysis)
{
    Table table{"omnibus",
                "All conditions at once, for these fabrics; Cochran's Q takes answers as independent",
                {"question", "test", "blocks", "statistic", "df", "p", "p (Greenhouse-Geisser)"},
                {}};
    const auto df = [](const stats::Value& first, const stats::Value& second) {
        return first.exists() && second.exists() ? fixed(*first, 0) + ", " + fixed(*second, 0) : std::string("-");
    };
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) {
        const auto& cochran = question.findings.cochran;
        table.rows.push_back({textCell(question.id()), textCell("Cochran's Q"), countCell(cochran.blocks),
                              numberCell(cochran.q, 2), numericTextCell(cochran.df.exists() ? fixed(*cochran.df, 0) : "-"),
                              pCell(cochran.p, cochran.logP), blankCell()});
    }
    for (const auto& question : questionsWith<RatingAnalysis>(analysis)) {
        const auto& anova = question.findings.anova;
        const auto& friedman = question.findings.friedman;
        table.rows.push_back({textCell(question.id()), textCell("RM-ANOVA F"), countCell(anova.blocks), numberCell(anova.f, 2),
                              numericTextCell(df(anova.df1, anova.df2)), pCell(anova.p, anova.logP),
                              pCell(anova.pGg, anova.logPGg)});
        table.rows.push_back({textCell(question.id()), textCell("Friedman Q"), countCell(friedman.blocks),
                              numberCell(friedman.q, 2), numericTextCell(friedman.df.exists() ? fixed(*friedman.df, 0) : "-"),
                              pCell(friedman.p, friedman.logP), blankCell()});
    }
    return table;
}

Table speedTable(const StudyAnalysis& analysis)
{
    Table table{"speed_accuracy",
                "Speed and accuracy of the first choice question; intervals over participants, for these fabrics",
                {"condition",
                 "median s",
                 "bits per second",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "balanced integration score"},
                {}};
    for (std::size_t c = 0; c < analysis.data.conditions.size(); ++c) {
        const ConditionSpeed& speed = analysis.speed[c];
        table.rows.push_back({conditionCell(analysis.data.conditions[c]), numberCell(speed.medianSeconds, 2),
                              numberCell(speed.bitsPerSecond, 4), numberCell(speed.bitsPerSecondCi95.low, 4),
                              numberCell(speed.bitsPerSecondCi95.high, 4), intervalCell(speed.bitsPerSecondCi95, 4),
                              numberCell(speed.balancedIntegrationScore, 2)});
    }
    return table;
}

bool isOfSimulation(const fs::path& folder)
{
    const auto results = nlohmann::json::parse(protocols::readIfPossible(folder / "results.json").value_or(""), nullptr, false);
    return results.is_object() && results.contains("study") && results["study"].is_object() &&
           results["study"].contains("simulated") && results["study"]["simulated"] == true && !fs::exists(folder / "index.html");
}

}  // namespace

std::vector<Table> simulationTables(const StudyAnalysis& analysis)
{
    std::vector<Table> tables;
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) tables.push_back(matchesTable(analysis, question));
    for (auto& one : ratingTables(analysis)) tables.push_back(std::move(one.table));
    tables.push_back(omnibusTable(analysis));
    pairTables(analysis, [&](ReportTable one) { tables.push_back(std::move(one.table)); });
    if (!questionsWith<ChoiceAnalysis>(analysis).empty()) tables.push_back(speedTable(analysis));
    for (Table& table : tables) {
        table.name = "simulated_" + table.name;
        table.caption = "Simulated participants. " + table.caption;
    }
    return tables;
}

void requireReplaceableSimulation(const fs::path& folder)
{
    std::error_code unreadable;
    if (!fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder, unreadable)) || isOfSimulation(folder)) return;
    throw protocols::badInput({"the folder holds files that no simulation in memory wrote", folder.string(),
                               "a new or empty folder, or that of an earlier simulation", "choose another folder with --out"});
}

void writeSimulation(const StudyAnalysis& analysis, const std::string& madeWith, const fs::path& folder)
{
    requireReplaceableSimulation(folder);
    protocols::FolderDraft draft(folder, protocols::Earlier::EntriesReplaced);
    protocols::makeFolders(draft.path() / "tables", protocols::Sync::Later);
    protocols::writeInPieces(
        draft.file("results.json"),
        [&](const protocols::TakeBytes& take) {
            writeResults(analysis, {{}, madeWith}, take);
        },
        protocols::Sync::Later);
    for (const Table& table : simulationTables(analysis)) {
        protocols::writeWholeFile(draft.file("tables/" + table.name + ".csv"), toCsv(table), protocols::Sync::Later);
        protocols::writeWholeFile(draft.file("tables/" + table.name + ".tex"), toTex(table), protocols::Sync::Later);
    }
    draft.putInPlace();
}

}  // namespace study::simulation
