// vis2hap report STUDY --out DIR, and report --from ANSWERS.csv --out DIR
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/protocol_json.h"
#include "reports/data/answers_csv.h"
#include "reports/documents/report_documents.h"
#include "reports/tables/overview_tables.h"
#include "reports/write_report.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/explanation.h"
#include "study/commands/parts/friction_pictures.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/pair_options.h"
#include "study/commands/parts/progress.h"
#include "study/commands/parts/script_check.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/recorded_act.h"
#include "study/records/blinded_report.h"
#include "study/records/log_heads.h"
#include "study/records/shown_origin.h"
#include "study/records/stored_study.h"

namespace study::commands {

namespace {

constexpr std::size_t resimulatedStudies = 2000;

struct ReportCall {
    std::string study, from, out, protocol, encoding, bounds, scale;
    std::vector<std::string> map, planned;
    std::optional<int> alternatives;
    bool quick = false;
    bool resimulate = false;
    bool everyPair = false;
    bool pageOnly = false;
    std::string checkWith;
    PassphraseOption passphrase;
};

constexpr double largestScaleEnd = 10'000;  ///< as in a protocol

/// One end of a scale, as a protocol may have it. Throws badInput, naming the whole text of the option.
protocols::Tenths scaleEnd(double number, const std::string& text)
{
    const double tenths = 10 * number;
    // 0.1 * 10 need not be 1 in binary; a number further off is not a tenth.
    constexpr double rounding = 1e-6;
    if (!(std::abs(number) <= largestScaleEnd) || std::abs(tenths - std::round(tenths)) > rounding)
        throw protocols::badInput({"\"" + text + "\" has an end that no scale can have", "--scale",
                                   "numbers from -10000 to 10000 with at most one decimal, e.g. --scale=1,5",
                                   "correct the ends of the scale"});
    return protocols::Tenths{static_cast<int>(std::lround(tenths))};
}

protocols::RatingScale scaleFrom(const std::string& text)
{
    const auto [low, high] = numbersInOrder(text, "--scale", "0,10");
    protocols::RatingScale scale;
    scale.min = scaleEnd(low, text);
    scale.max = scaleEnd(high, text);
    return scale;
}

/// Options that describe a file of answers do not apply to a study, which has its protocol.
void requireFile(const ReportCall& call)
{
    const bool isDescribed = !call.protocol.empty() || !call.encoding.empty() || !call.bounds.empty() || !call.scale.empty() ||
                             !call.map.empty() || !call.planned.empty() || call.alternatives.has_value();
    if (isDescribed && call.from.empty())
        throw protocols::badInput(
            {"--protocol, --map, --bounds, --planned, --scale, --alternatives and --encoding describe a file of answers",
             call.study, "--from ANSWERS.csv", "leave these options out"});
}

reports::AnswersCsvOptions fileOptionsOf(const ReportCall& call)
{
    reports::AnswersCsvOptions options;
    options.alternatives = call.alternatives;
    options.rows.encoding = call.encoding;
    for (const std::string& pair : call.map) options.rows.names.push_back(wordsAround(pair, '=', "--map", "correct=hit"));
    for (const std::string& pair : call.planned)
        options.planned.push_back(wordsAround(pair, ',', "--planned", "\"h_g&f_g,h&f\""));
    if (!call.bounds.empty()) options.equivalenceBounds = numbersInOrder(call.bounds, "--bounds", "-0.5,0.5");
    if (!call.scale.empty()) options.scale = scaleFrom(call.scale);
    options.note = [](const std::string& sentence) { std::fprintf(stderr, "%s\n", protocols::printable(sentence).c_str()); };
    if (!call.protocol.empty()) {
        options.protocol = protocols::readProtocol(call.protocol);
        options.protocolSha256 = protocols::sha256OfFile(call.protocol);
    }
    return options;
}

/// Empty for a blinded study whose passphrase nobody gives.
std::optional<reports::StudyData> dataFor(const ReportCall& call, const std::optional<database::StudyStore>& store)
{
    if (store) return records::studyData(*store, passphraseFrom(call.passphrase));
    return reports::readAnswersCsv(call.from, fileOptionsOf(call));
}

reports::ReportOrigin originOf(const std::optional<database::StudyStore>& store)
{
    if (!store) return {};
    return {records::headTextOf(*store), records::shownMadeWith(*store, store->facts())};
}

int report(const ReportCall& call, StageTimes times)
{
    if (call.study.empty() == call.from.empty())
        throw protocols::badInput(
            {"there is nothing to report on", "", "either a STUDY or --from ANSWERS.csv", "see `vis2hap report --help`"});
    requireFile(call);
    std::optional<database::StudyStore> store;  // none for answers from elsewhere
    if (!call.study.empty()) store.emplace(records::openStudy(call.study));
    std::optional<StateForFiles> state;
    if (store) state.emplace(*store);
    std::optional<reports::StudyData> data = dataFor(call, store);
    if (!data) {
        times.begin("writing the blinded report");
        reports::writeProgressReport(records::blindedReport(*store), call.out);
        times.end();
        state->record("report", call.out);
        std::printf("%s/index.html: progress, balance and flags; the rest needs the owner's passphrase\n",
                    protocols::printable(call.out).c_str());
        if (!call.checkWith.empty()) checkReport(call.out, call.checkWith);
        return 0;
    }
    data->everyPair = call.everyPair;
    const auto note = [](const std::string& line) { std::fprintf(stderr, "%s\n", protocols::printable(line).c_str()); };
    if (store && !call.quick) data->pictures = frictionPictures(*store, *data, note);
    Progress progress("analysing");
    reports::AnalysisOptions options{call.quick ? reports::Depth::Quick : reports::Depth::Whole,
                                     call.resimulate ? resimulatedStudies : 0, [&](int done, int total, const std::string& step) {
                                         times.begin(step);
                                         progress.show(done, total, step);
                                     }};
    const reports::StudyAnalysis analysis = reports::analyse(std::move(*data), options);
    times.begin("writing tables, figures and pages");
    reports::writeReport(analysis, call.out, originOf(store),
                         call.pageOnly ? reports::WriteDocuments() : reports::allDocuments(note));
    times.end();
    if (state) state->record("report", call.out);
    std::printf("%s\n%s/index.html\n", protocols::printableLines(reports::overviewText(analysis)).c_str(),
                protocols::printable(call.out).c_str());
    if (!call.checkWith.empty()) checkReport(call.out, call.checkWith);
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
    command
        ->add_option("--alternatives", call->alternatives,
                     "with --from: answers to choose among, in every choice question that neither a protocol nor the file "
                     "describes (default: 3)")
        ->check(CLI::Range(2, 100));
    command->add_option("--map", call->map, "with --from: MEANING=COLUMN, where a column has another name, e.g. correct=hit")
        ->allow_extra_args(false);
    command->add_option("--bounds", call->bounds,
                        "with --from: bounds of equivalence, LOW,HIGH (default: the protocol's, or a twentieth of the scale)");
    command->add_option("--planned", call->planned, "with --from: a planned contrast A,B; the first is the primary one")
        ->allow_extra_args(false);
    command->add_option("--scale", call->scale,
                        "with --from: ends of the rating scale, LOW,HIGH (default: the protocol's, or 0,10); ratings outside are "
                        "refused, and so is a protocol with other ends");
    command->add_option("--encoding", call->encoding, "with --from: encoding of the file (default: found in the file)");
    command->add_flag("--pairs", call->everyPair, "compare all pairs of conditions, also where there are more than 1000");
    command->add_flag("--resimulate", call->resimulate,
                      "count false claims in 2000 simulated studies like this one (takes longer)");
    command->add_flag("--quick", call->quick, "leave out what only stands beside the claims; the report says so");
    command->add_flag("--page-only", call->pageOnly, "leave out report.pdf, report.tex, report.docx and figures/*.pdf");
    command
        ->add_option("--check-with", call->checkWith,
                     "R or python: let the script in OUT/reproduce compute the main tables again, where it is installed")
        ->check(CLI::IsMember({"R", "python"}));
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, command, &action] {
        // Documents need fonts; the page does not.
        action.surroundings = call->pageOnly ? Surroundings::Core : Surroundings::Offscreen;
        action.handlesStudy = true;
        action.work = [call, command] { return report(*call, StageTimes(isExplained(*command))); };
    });
}

}  // namespace study::commands
