// vis2hap report STUDY --out DIR, and report --from ANSWERS.csv --out DIR
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/protocol_json.h"
#include "reports/data/answers_csv.h"
#include "reports/tables/overview_tables.h"
#include "reports/write_report.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/progress.h"
#include "study/commands/recorded_act.h"
#include "study/records/blinded_report.h"
#include "study/records/stored_study.h"

namespace study::commands {

namespace {

constexpr std::size_t resimulatedStudies = 2000;

struct ReportCall {
    std::string study, from, out, protocol;
    int alternatives = 3;
    bool quick = false;
    bool resimulate = false;
    bool everyPair = false;
    PassphraseOption passphrase;
};

/// Empty for a blinded study whose passphrase nobody gives.
std::optional<reports::StudyData> dataFor(const ReportCall& call)
{
    if (call.from.empty()) return records::studyData(records::openStudy(call.study), passphraseFrom(call.passphrase));
    reports::AnswersCsvOptions options;
    options.alternatives = call.alternatives;
    if (!call.protocol.empty()) {
        options.protocol = protocols::readProtocol(call.protocol);
        options.protocolSha256 = protocols::sha256OfFile(call.protocol);
    }
    return reports::readAnswersCsv(call.from, options);
}

reports::ReportOrigin originOf(const ReportCall& call)
{
    if (call.study.empty()) return {};
    const auto store = records::openStudy(call.study);
    return {textOf(store.head()), store.facts().madeWith};
}

int report(const ReportCall& call)
{
    if (call.study.empty() == call.from.empty())
        throw protocols::badInput(
            {"there is nothing to report on", "", "either a STUDY or --from ANSWERS.csv", "see `vis2hap report --help`"});
    std::optional<reports::StudyData> data = dataFor(call);
    if (!data) {
        const auto store = records::openStudy(call.study);
        reports::writeProgressReport(records::blindedReport(store), call.out);
        recordAct(store, "report", call.out);
        std::printf("%s/index.html: progress, balance and flags; the rest needs the owner's passphrase\n", call.out.c_str());
        return 0;
    }
    data->everyPair = call.everyPair;
    Progress progress("analysing");
    reports::AnalysisOptions options{call.quick ? reports::Depth::Quick : reports::Depth::Whole,
                                     call.resimulate ? resimulatedStudies : 0,
                                     [&](int done, int total, const std::string& step) { progress.show(done, total, step); }};
    const reports::StudyAnalysis analysis = reports::analyse(std::move(*data), options);
    reports::writeReport(analysis, call.out, originOf(call));
    std::printf("%s\n%s/index.html\n", reports::overviewText(analysis).c_str(), call.out.c_str());
    if (!call.study.empty()) recordAct(records::openStudy(call.study), "report", call.out);
    return 0;
}

}  // namespace

void addReport(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("report", "result tables, figures and documents; blinded until the study is unblinded");
    auto call = std::make_shared<ReportCall>();
    command->add_option("STUDY", call->study, "the study");
    command->add_option("--from", call->from, "answers collected elsewhere: participant,fabric,condition,Q1_correct,Q2,Q3,Q4");
    command->add_option("--out", call->out, "folder of the report")->required();
    command->add_option("--protocol", call->protocol, "with --from: bounds, contrasts and questions from this protocol");
    command->add_option("--alternatives", call->alternatives, "with --from: fabrics to choose among in Q1")
        ->check(CLI::Range(2, 100))
        ->capture_default_str();
    command->add_flag("--pairs", call->everyPair, "compare all pairs of conditions, also where there are more than 1000");
    command->add_flag("--resimulate", call->resimulate,
                      "count false claims in 2000 simulated studies like this one (takes longer)");
    command->add_flag("--quick", call->quick, "leave out what only stands beside the claims; the report says so");
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return report(*call); };
    });
}

}  // namespace study::commands
