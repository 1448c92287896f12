#include "study/making/study_sheets.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cstdio>
#include <utility>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "protocols/scale_drawing.h"
#include "protocols/usual_texts.h"
#include "study/records/stored_study.h"

namespace study::making {

namespace {

using protocols::shortest;

/// Texts for the operator, in the language of the window.
struct SheetText {
    Q_DECLARE_TR_FUNCTIONS(study::making::SheetText)
};

/// HTML. (lupdate mistakes functions that return std::string for members of a namespace std.)
using Markup = std::string;

Markup marked(const QString& text) { return protocols::escapedMarkup(text.toStdString()); }

Markup operatorsLanguage() { return SheetText::tr("en", "language of the sheets").toStdString(); }

/// The number with the decimal mark of the participants' language.
std::string spokenNumber(double value, const protocols::Protocol& protocol)
{
    std::string text = shortest(value);
    if (const auto point = text.find('.'); point != std::string::npos)
        text.replace(point, 1, participantText(protocol, "decimal_mark"));
    return text;
}

/// What every page says about the log when it was printed.
struct PrintedHead {
    std::string study;  ///< name of the folder
    database::LogHead head;
};

/// Begins the command in the foot of every page.
constexpr const char* checkCommand = "<code>vis2hap verify ";

Markup footOf(const PrintedHead& printed)
{
    const std::string head = shortTextOf(printed.head);
    const QString entries =
        printed.head.sequence == 1 ? SheetText::tr("1 entry") : SheetText::tr("%1 entries").arg(printed.head.sequence);
    const QString check = checkCommand + QString::fromStdString(protocols::escapedMarkup(protocols::shellWord(printed.study))) +
                          " --against " + QString::fromStdString(head) + "</code>";
    const QString sentences =
        QString::fromStdString(marked(SheetText::tr("Head of the log when this page was made: %1 (%2). Check: %3")));
    return "<p class=\"foot\">" + sentences.arg("<b>" + QString::fromStdString(head) + "</b>", entries, check).toStdString() +
           "</p>\n";
}

/// `title` and `language` are plain text, `body` is markup.
Markup page(const std::string& title, const std::string& body, const PrintedHead& printed,
            const std::string& language = operatorsLanguage())
{
    return "<!DOCTYPE html>\n<html lang=\"" + protocols::escapedMarkup(language) + "\"><head><meta charset=\"utf-8\"><title>" +
           protocols::escapedMarkup(title) +
           "</title><style>\n"
           "body{font:14pt 'DejaVu Sans',sans-serif;margin:15mm;color:#000;background:#fff;overflow-wrap:anywhere}\n"
           "h1{font-size:20pt}h2{font-size:15pt;margin-top:10mm}p,table{max-width:170mm}\n"
           "table{border-collapse:collapse;table-layout:fixed;width:100%}tr{page-break-inside:avoid}\n"
           "td,th{border:1px solid #000;padding:2mm 3mm;text-align:left}th{font-size:12pt}\n"
           ".blank td{height:9mm}.blank th{font-size:9pt;padding:2mm}\n"
           ".label{display:inline-block;border:1px dashed #000;padding:5mm 9mm;margin:2mm;text-align:center}\n"
           ".label b{display:block;font-size:26pt;border-bottom:1mm solid #000}.label small{font-size:9pt}\n"
           ".ends{display:flex;justify-content:space-between;margin:0 5.9%}.ends span{width:47%}\n"
           ".ends span+span{text-align:right}.sheet+.sheet{page-break-before:always}.foot{font-size:9pt;margin-top:10mm}\n"
           "</style></head><body>\n<h1>" +
           protocols::escapedMarkup(title) + "</h1>\n" + body + footOf(printed) + "</body></html>\n";
}

Markup paragraph(const QString& text) { return "<p>" + marked(text) + "</p>\n"; }

/// A column of a table. Its width is fixed, so that a long name pushes no other column off the page.
struct Column {
    QString caption;
    const char* width;  ///< CSS; "auto": an equal share of the rest
};

/// Beginning of a table. Each page that the table reaches begins with `title` (markup, may be empty) and the captions.
Markup tableHead(const Markup& title, std::initializer_list<Column> columns)
{
    std::string widths, captions;
    for (const Column& column : columns) {
        widths += "<col style=\"width:" + std::string(column.width) + "\">";
        captions += "<th>" + marked(column.caption) + "</th>";
    }
    const std::string titleRow =
        title.empty() ? "" : "<tr><th colspan=\"" + std::to_string(columns.size()) + "\">" + title + "</th></tr>\n";
    return "<colgroup>" + widths + "</colgroup>\n<thead>" + titleRow + "<tr>" + captions + "</tr></thead>\n";
}

/// One set of labels. All slots share one set where the pieces are labelled once.
struct LabelSet {
    std::string title;  ///< markup
    protocols::SwatchLabels codes;
    bool isOfOnePlace = true;
};

std::vector<LabelSet> labelSetsOf(const database::StudyFacts& facts, const protocols::Protocol& protocol)
{
    std::vector<LabelSet> sets;
    if (facts.swatches.empty()) return sets;
    if (protocol.swatchCodes == protocols::SwatchCodes::Once)
        return {{marked(SheetText::tr("All participants")), facts.swatches.front(), false}};
    for (std::size_t slot = 0; slot < facts.swatches.size(); ++slot)
        sets.push_back({marked(SheetText::tr("Place %1").arg(slot + 1)), facts.swatches[slot]});
    return sets;
}

Markup labelsPage(const database::StudyFacts& facts, const std::vector<LabelSet>& sets, const PrintedHead& printed)
{
    std::string body =
        paragraph(SheetText::tr("Cut out the labels. Fix each label to the back of its piece, as the preparation sheet shows.")) +
        paragraph(SheetText::tr("The line on a label is below the code, so that nobody reads 199 as 661."));
    for (const auto& set : sets) {
        // Labels of several places lie on one table after they were cut out.
        const std::string place = set.isOfOnePlace ? "<small>" + set.title + "</small>" : "";
        body += "<div class=\"sheet\"><h2>" + set.title + "</h2>\n";
        for (const auto& [fabric, code] : set.codes)
            body += "<span class=\"label\"><b>" + protocols::escapedMarkup(code) + "</b>" + place + "</span>";
        body += "</div>\n";
    }
    return page(SheetText::tr("%1: labels of the fabric pieces").arg(QString::fromStdString(facts.name)).toStdString(), body,
                printed);
}

/// Throws workFailed for a fabric that the study does not have: somebody altered its rows.
const std::string& nameOfFabric(const database::StudyFacts& facts, const protocols::FabricId& fabric)
{
    const auto found = facts.fabricNames.find(fabric);
    if (found == facts.fabricNames.end())
        throw protocols::workFailed({"a code stands for the fabric " + fabric.value + ", which the study does not have",
                                     "study.db", "a fabric of the study for each code", "run vis2hap verify"});
    return found->second;
}

/// A scale of the protocol, and the questions that are rated on it.
struct CardScale {
    protocols::RatingScale scale;
    std::vector<std::string> questions;  ///< their texts
};

/// The different scales in the order of the phases.
std::vector<CardScale> cardScalesOf(const protocols::Protocol& protocol)
{
    std::vector<CardScale> cards;
    for (const protocols::Phase& phase : protocol.phases)
        for (const protocols::Question& question : phase.questions) {
            const auto* rating = std::get_if<protocols::Rating>(&question.kind);
            if (rating == nullptr) continue;
            auto card = std::ranges::find(cards, rating->scale, &CardScale::scale);
            if (card == cards.end()) card = cards.insert(card, {rating->scale, {}});
            card->questions.push_back(question.text);
        }
    return cards;
}

/// What participants touch to learn a scale without words; empty where there is none. A text of the study may translate the usual
/// one or name other materials, so the usual ones are always named.
QString materialsOfEnds(const protocols::Protocol& protocol, const std::vector<CardScale>& cards)
{
    if (std::ranges::none_of(cards, [](const CardScale& card) { return card.scale.labels.empty(); })) return {};
    for (const char* key : {"card_low", "scale_low", "card_high", "scale_high"})
        if (protocol.participantTexts.contains(key))
            return SheetText::tr(
                "You also need the materials for the two ends of the scale. The usual ones are sandpaper, silk and "
                "a second piece of one fabric. Your study's own texts may name others.");
    return SheetText::tr("You also need sandpaper, silk and a second piece of one fabric, for the two ends of the scale.");
}

Markup preparationPage(const database::StudyFacts& facts, const std::vector<LabelSet>& sets, const QString& materialsOfEnds,
                       const PrintedHead& printed)
{
    std::string body =
        paragraph(SheetText::tr("For the person who labels the pieces. The operator of a session only needs the codes."));
    for (const auto& set : sets) {
        body += "<div class=\"sheet\">\n<table>" +
                tableHead(set.title,
                          {{SheetText::tr("code"), "18%"}, {SheetText::tr("id"), "20%"}, {SheetText::tr("fabric"), "auto"}});
        for (const auto& [fabric, code] : set.codes)
            body += "<tr><td><b>" + protocols::escapedMarkup(code) + "</b></td><td>" + protocols::escapedMarkup(fabric.value) +
                    "</td><td>" + protocols::escapedMarkup(nameOfFabric(facts, fabric)) + "</td></tr>\n";
        body += "</table>\n";
        if (!materialsOfEnds.isEmpty()) body += paragraph(materialsOfEnds);
        if (!facts.familiarisation.empty()) {
            QStringList names;
            for (const auto& item : facts.familiarisation) names << QString::fromStdString(item.name);
            body += paragraph(SheetText::tr("Fabrics for familiarisation with the display: %1.")
                                  .arg(names.join(SheetText::tr(", ", "between the names of a list"))));
        }
        body += "</div>\n";
    }
    return page(SheetText::tr("%1: preparation of the fabric pieces").arg(QString::fromStdString(facts.name)).toStdString(), body,
                printed);
}

/// The line with its equal sections, and the words of its ends, each below its half of the line. Only the ends have numbers,
/// because the participant memorises the rest.
Markup scaleDrawing(const protocols::RatingScale& scale, const protocols::Protocol& protocol)
{
    const double width = 900, left = 60;
    std::string svg = "<svg viewBox=\"0 0 1020 130\" width=\"100%\" role=\"img\" aria-label=\"" +
                      protocols::escapedMarkup(participantText(protocol, "card_title")) +
                      "\">"
                      "<line x1=\"60\" y1=\"80\" x2=\"960\" y2=\"80\" stroke=\"#000\" stroke-width=\"5\"/>";
    const int sections = drawnSections(scale);
    for (int mark = 0; mark <= sections; ++mark) {
        const std::string x = shortest(left + width * mark / sections);
        const bool isEnd = mark == 0 || mark == sections;
        svg += "<line x1=\"" + x + "\" x2=\"" + x + "\" y1=\"" + (isEnd ? "45" : "62") + "\" y2=\"" + (isEnd ? "115" : "98") +
               "\" stroke=\"#000\" stroke-width=\"4\"/>";
    }
    const auto number = [&](double x, protocols::Tenths value) {
        return "<text x=\"" + shortest(x) + "\" y=\"30\" font-size=\"32\" font-weight=\"bold\" text-anchor=\"middle\">" +
               spokenNumber(value.inScaleUnits(), protocol) + "</text>";
    };
    const bool hasWords = !scale.labels.empty();
    const std::string low = hasWords ? scale.labels.front() : participantText(protocol, "scale_low");
    const std::string high = hasWords ? scale.labels.back() : participantText(protocol, "scale_high");
    return svg + number(left, scale.min) + number(left + width, scale.max) + "</svg>\n<div class=\"ends\"><span>" +
           protocols::escapedMarkup(low) + "</span><span>" + protocols::escapedMarkup(high) + "</span></div>\n";
}

/// What stands on the card of one scale.
Markup scaleText(const protocols::Protocol& protocol, const protocols::RatingScale& scale)
{
    const auto sentence = [&](const char* key) { return protocols::escapedMarkup(participantText(protocol, key)); };
    const auto number = [&](protocols::Tenths value) { return spokenNumber(value.inScaleUnits(), protocol); };
    std::string body = "<p>" + sentence("card_text") + "</p>\n" + scaleDrawing(scale, protocol);
    if (scale.labels.empty())
        body += "<p>" + protocols::filledText(sentence("card_low"), {{"number", "<b>" + number(scale.min) + "</b>"}}) + "<br>" +
                protocols::filledText(sentence("card_high"), {{"number", "<b>" + number(scale.max) + "</b>"}}) + "<br>" +
                protocols::filledText(sentence("card_between"), {{"step", number(scale.step)}}) + "</p>\n";
    else {
        body += "<p>";
        protocols::Tenths value = scale.min;
        for (const auto& label : scale.labels) {
            body += "<b>" + number(value) + "</b> " + protocols::escapedMarkup(label) + "<br>";
            value.value += scale.step.value;
        }
        body += "</p>\n";
    }
    return body;
}

/// For the participant, in the participant's language: a card for each scale. Several cards name their questions.
Markup scaleCards(const database::StudyFacts& facts, const protocols::Protocol& protocol, const std::vector<CardScale>& cards,
                  const PrintedHead& printed)
{
    std::string body;
    for (const CardScale& card : cards) {
        body += "<div class=\"sheet\">\n";
        if (cards.size() > 1)
            for (const std::string& question : card.questions) body += "<h2>" + protocols::escapedMarkup(question) + "</h2>\n";
        body += scaleText(protocol, card.scale) + "</div>\n";
    }
    return page(facts.name + ": " + participantText(protocol, "card_title"), body, printed, protocol.language);
}

/// One row a sitting, to fill in by hand.
Markup sessionPage(const database::StudyFacts& facts, const PrintedHead& printed)
{
    constexpr int rows = 12;
    std::string body =
        paragraph(SheetText::tr(
            "At the end of a sitting the app shows the head of the log. Copy it here: the number, the colon and the 16 digits. "
            "Keep this sheet away from the computer. It then shows later whether the log was cut, put back or written anew.")) +
        "<table class=\"blank\">" +
        tableHead({}, {{SheetText::tr("date"), "24mm"},
                       {SheetText::tr("participant"), "auto"},
                       {SheetText::tr("operator"), "auto"},
                       {SheetText::tr("head of the log"), "62mm"}});
    for (int row = 0; row < rows; ++row) body += "<tr><td></td><td></td><td></td><td></td></tr>\n";
    return page(SheetText::tr("%1: sittings").arg(QString::fromStdString(facts.name)).toStdString(), body + "</table>\n",
                printed);
}

/// The sentences, and their order for each slot.
Markup instructionsPage(const database::StudyStore& store, const protocols::Protocol& protocol, const std::string& study,
                        const PrintedHead& printed)
{
    std::string body =
        paragraph(SheetText::tr("The app shows each sentence at the beginning of its block. Read it aloud.")) + "<table>" +
        tableHead(
            {},
            {{SheetText::tr("questions"), "22%"}, {SheetText::tr("instruction"), "26%"}, {SheetText::tr("sentence"), "auto"}});
    for (const auto& phase : protocol.phases)
        for (const auto& instruction : phase.instructions) {
            std::string questions;
            for (const auto& question : phase.questions) questions += (questions.empty() ? "" : ", ") + question.id.value;
            body += "<tr><td>" + protocols::escapedMarkup(questions) + "</td><td>" +
                    protocols::escapedMarkup(instruction.id.value) + "</td><td>" + protocols::escapedMarkup(instruction.text) +
                    "</td></tr>\n";
        }
    body += "</table>\n<h2>" + marked(SheetText::tr("Order")) + "</h2>\n<table>" +
            tableHead({}, {{SheetText::tr("place"), "20%"}, {SheetText::tr("instructions"), "auto"}});
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
        body += "<tr><td>" + std::to_string(slot.number) + "</td><td>" + protocols::escapedMarkup(order) + "</td></tr>\n";
    }
    return page(SheetText::tr("%1: instructions of the blocks").arg(QString::fromStdString(study)).toStdString(),
                body + "</table>\n", printed);
}

/// Removes a page of another study, or of this one before an amendment. Keeps a file with this name that is no such page.
void removeEarlierSheet(const std::filesystem::path& sheet)
{
    std::error_code problem;
    if (!std::filesystem::is_regular_file(sheet, problem)) return;
    if (protocols::readWholeFile(sheet).find(checkCommand) == std::string::npos) return;
    if (!std::filesystem::remove(sheet, problem) && problem)
        throw protocols::environmentFault({"a sheet of an earlier run cannot be removed: " + problem.message(), sheet.string(),
                                           "a folder with the sheets of this study only",
                                           "delete the file, or write the sheets to another folder"});
}

}  // namespace

void writeSheets(const database::StudyStore& store, const std::filesystem::path& out)
{
    const auto facts = store.facts();
    const auto protocol = records::latestProtocolOf(store);
    const auto sets = labelSetsOf(facts, protocol);
    const auto folder = std::filesystem::absolute(store.folder().folder).lexically_normal();
    const PrintedHead printed{(folder.has_filename() ? folder : folder.parent_path()).filename().string(), store.head()};
    const auto cards = cardScalesOf(protocol);
    const std::pair<const char*, Markup> sheets[] = {
        {"labels.html", labelsPage(facts, sets, printed)},
        {"session.html", sessionPage(facts, printed)},
        {"preparation.html", preparationPage(facts, sets, materialsOfEnds(protocol, cards), printed)},
        {"scale-card.html", cards.empty() ? "" : scaleCards(facts, protocol, cards, printed)},
        {"instructions.html", hasInstructions(protocol) ? instructionsPage(store, protocol, facts.name, printed) : ""}};
    protocols::FolderDraft draft(out, protocols::Earlier::FilesJoined);
    for (const auto& [name, html] : sheets)
        if (!html.empty()) protocols::writeWholeFile(draft.file(name), html, protocols::Sync::Later);
    draft.putInPlace();
    for (const auto& [name, html] : sheets)
        if (html.empty()) removeEarlierSheet(out / name);
}

}  // namespace study::making
