#include "study/making/study_sheets.h"

#include <cstdio>

#include "protocols/files/csv_table.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "study/records/stored_study.h"

namespace study::making {

namespace {

using protocols::shortest;

/// What every page says about the log when it was printed.
struct PrintedHead {
    std::string study;  ///< name of the folder
    database::LogHead head;
};

std::string footOf(const PrintedHead& printed)
{
    const std::string head = shortTextOf(printed.head);
    return "<p class=\"foot\">Head of the log when this page was made: <b>" + head + "</b> (" +
           std::to_string(printed.head.sequence) + (printed.head.sequence == 1 ? " entry" : " entries") +
           "). Check: <code>vis2hap verify " + protocols::escapedMarkup(printed.study) + " --against " + head + "</code></p>\n";
}

std::string page(const std::string& title, const std::string& body, const PrintedHead& printed)
{
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + protocols::escapedMarkup(title) +
           "</title><style>\n"
           "body{font:14pt 'DejaVu Sans',sans-serif;margin:15mm;color:#000;background:#fff}\n"
           "h1{font-size:20pt}h2{font-size:15pt;margin-top:10mm}table{border-collapse:collapse}\n"
           "td,th{border:1px solid #000;padding:2mm 5mm;text-align:left}\n"
           ".label{display:inline-block;border:1px dashed #000;padding:6mm 9mm;margin:2mm;font-size:26pt;font-weight:bold}\n"
           ".sheet{page-break-after:always}p{max-width:170mm}.foot{font-size:9pt;margin-top:10mm}.blank "
           "td{height:9mm;min-width:25mm}\n"
           "</style></head><body>\n<h1>" +
           protocols::escapedMarkup(title) + "</h1>\n" + body + footOf(printed) + "</body></html>\n";
}

/// One set of labels. All slots share one set where the pieces are labelled once.
struct LabelSet {
    std::string title;
    protocols::SwatchLabels codes;
};

std::vector<LabelSet> labelSetsOf(const database::StudyFacts& facts, const protocols::Protocol& protocol)
{
    std::vector<LabelSet> sets;
    if (facts.swatches.empty()) return sets;
    if (protocol.swatchCodes == protocols::SwatchCodes::Once) return {{"All participants", facts.swatches.front()}};
    for (std::size_t slot = 0; slot < facts.swatches.size(); ++slot)
        sets.push_back({"Slot " + std::to_string(slot + 1), facts.swatches[slot]});
    return sets;
}

std::string labelsPage(const database::StudyFacts& facts, const std::vector<LabelSet>& sets, const PrintedHead& printed)
{
    std::string body = "<p>Cut out the labels. Fix each label to the back of its piece, as the preparation sheet shows.</p>\n";
    for (const auto& set : sets) {
        body += "<h2>" + set.title + "</h2>\n<div>";
        for (const auto& [fabric, code] : set.codes) body += "<span class=\"label\">" + code + "</span>";
        body += "</div>\n";
    }
    return page(facts.name + ": labels of the fabric pieces", body, printed);
}

std::string preparationPage(const database::StudyFacts& facts, const std::vector<LabelSet>& sets, const PrintedHead& printed)
{
    std::string body = "<p>For the person who labels the pieces. The operator of a session only needs the codes.</p>\n";
    for (const auto& set : sets) {
        body += "<div class=\"sheet\"><h2>" + set.title + "</h2>\n<table><tr><th>code</th><th>fabric</th><th>id</th></tr>\n";
        for (const auto& [fabric, code] : set.codes)
            body += "<tr><td><b>" + code + "</b></td><td>" + protocols::escapedMarkup(facts.fabricNames.at(fabric)) +
                    "</td><td>" + protocols::escapedMarkup(fabric.value) + "</td></tr>\n";
        body += "</table>\n<p>You also need sandpaper, silk and a second piece of one fabric, for the two ends of the scale.</p>";
        if (!facts.familiarisation.empty()) {
            body += "<p>Fabrics for familiarisation with the display:";
            for (const auto& item : facts.familiarisation)
                body += " " + protocols::escapedMarkup(item.name) + (&item == &facts.familiarisation.back() ? "." : ",");
            body += "</p>";
        }
        body += "</div>\n";
    }
    return page(facts.name + ": preparation of the fabric pieces", body, printed);
}

/// The line with its equal sections. Only the ends have numbers, because the participant memorises the rest.
std::string scaleDrawing(const protocols::RatingScale& scale)
{
    const double width = 900, left = 60;
    std::string svg =
        "<svg viewBox=\"0 0 1020 190\" width=\"100%\" role=\"img\" aria-label=\"the scale\">"
        "<line x1=\"60\" y1=\"80\" x2=\"960\" y2=\"80\" stroke=\"#000\" stroke-width=\"5\"/>";
    for (int mark = 0; mark <= scale.sections; ++mark) {
        const std::string x = shortest(left + width * mark / scale.sections);
        const bool isEnd = mark == 0 || mark == scale.sections;
        svg += "<line x1=\"" + x + "\" x2=\"" + x + "\" y1=\"" + (isEnd ? "45" : "62") + "\" y2=\"" + (isEnd ? "115" : "98") +
               "\" stroke=\"#000\" stroke-width=\"4\"/>";
    }
    const auto end = [&](double x, protocols::Tenths value, const char* anchor, const char* words) {
        return "<text x=\"" + shortest(x) + "\" y=\"30\" font-size=\"32\" font-weight=\"bold\" text-anchor=\"middle\">" +
               shortest(value.inScaleUnits()) + "</text><text x=\"" + shortest(x) +
               "\" y=\"160\" font-size=\"24\" text-anchor=\"" + anchor + "\">" + words + "</text>";
    };
    return svg +
           end(left, scale.min, "start",
               scale.labels.empty() ? "unrelated" : protocols::escapedMarkup(scale.labels.front()).c_str()) +
           end(left + width, scale.max, "end",
               scale.labels.empty() ? "totally the same" : protocols::escapedMarkup(scale.labels.back()).c_str()) +
           "</svg>\n";
}

std::string scaleCard(const database::StudyFacts& facts, const protocols::RatingScale& scale, const PrintedHead& printed)
{
    std::string body = "<p>Memorise this line. You will not see it during the session.</p>\n" + scaleDrawing(scale);
    if (scale.labels.empty())
        body += "<p><b>" + shortest(scale.min.inScaleUnits()) + "</b> means as different as sandpaper and silk. <b>" +
                shortest(scale.max.inScaleUnits()) +
                "</b> means as similar as two pieces of the same fabric. You may say any number in between, in steps of " +
                shortest(scale.step.inScaleUnits()) + ".</p>\n";
    else {
        body += "<ol start=\"" + shortest(scale.min.inScaleUnits()) + "\">";
        for (const auto& label : scale.labels) body += "<li>" + protocols::escapedMarkup(label) + "</li>";
        body += "</ol>\n";
    }
    return page(facts.name + ": the scale", body, printed);
}

/// One row a sitting, to fill in by hand.
std::string sessionPage(const database::StudyFacts& facts, const PrintedHead& printed)
{
    constexpr int rows = 12;
    std::string body =
        "<p>At the end of a sitting the app shows the head of the log. Copy it here: the number, the colon and the 16 digits. "
        "Keep "
        "this sheet away from the computer. It then shows later whether the log was cut, put back or written anew.</p>\n"
        "<table><tr><th>date</th><th>participant</th><th>operator</th><th>head of the log</th></tr>\n";
    for (int row = 0; row < rows; ++row) body += "<tr class=\"blank\"><td></td><td></td><td></td><td></td></tr>\n";
    return page(facts.name + ": sittings", body + "</table>\n", printed);
}

/// The sentences, and their order for each slot.
std::string instructionsPage(const database::StudyStore& store, const protocols::Protocol& protocol, const std::string& study,
                             const PrintedHead& printed)
{
    std::string body =
        "<p>The app shows each sentence at the beginning of its block. Read it aloud.</p>\n<table><tr>"
        "<th>questions</th><th>instruction</th><th>sentence</th></tr>\n";
    for (const auto& phase : protocol.phases)
        for (const auto& instruction : phase.instructions) {
            std::string questions;
            for (const auto& question : phase.questions) questions += (questions.empty() ? "" : ", ") + question.id.value;
            body += "<tr><td>" + protocols::escapedMarkup(questions) + "</td><td>" + instruction.id.value + "</td><td>" +
                    protocols::escapedMarkup(instruction.text) + "</td></tr>\n";
        }
    body += "</table>\n<h2>Order</h2>\n<table><tr><th>slot</th><th>instructions</th></tr>\n";
    for (const auto& slot : store.slots()) {
        std::string order;
        protocols::InstructionId before;
        int phase = -1;
        for (const auto& trial : store.trials(slot.number)) {
            if (trial.phase == phase && trial.instruction == before) continue;
            phase = trial.phase;
            before = trial.instruction;
            if (!before.empty()) order += (order.empty() ? "" : ", ") + before.value;
        }
        body += "<tr><td>" + std::to_string(slot.number) + "</td><td>" + order + "</td></tr>\n";
    }
    return page(study + ": instructions of the blocks", body + "</table>\n", printed);
}

}  // namespace

void writeSheets(const database::StudyStore& store, const std::filesystem::path& out)
{
    const auto facts = store.facts();
    const auto protocol = records::protocolOf(facts);
    const auto sets = labelSetsOf(facts, protocol);
    const auto folder = std::filesystem::absolute(store.folder().folder).lexically_normal();
    const PrintedHead printed{(folder.has_filename() ? folder : folder.parent_path()).filename().string(), store.head()};
    protocols::FolderDraft draft(out, protocols::Earlier::FilesJoined);
    const auto write = [&](const char* name, const std::string& html) {
        protocols::writeWholeFile(draft.file(name), html, protocols::Sync::Later);
    };
    write("labels.html", labelsPage(facts, sets, printed));
    write("session.html", sessionPage(facts, printed));
    write("preparation.html", preparationPage(facts, sets, printed));
    if (const auto* scale = memorisedScaleOf(protocol)) write("scale-card.html", scaleCard(facts, *scale, printed));
    if (hasInstructions(protocol)) write("instructions.html", instructionsPage(store, protocol, facts.name, printed));
    draft.putInPlace();
}

}  // namespace study::making
