#include "study/making/study_sheets.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cstdio>

#include "protocols/files/csv_table.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
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

Markup footOf(const PrintedHead& printed)
{
    const std::string head = shortTextOf(printed.head);
    const QString entries =
        printed.head.sequence == 1 ? SheetText::tr("1 entry") : SheetText::tr("%1 entries").arg(printed.head.sequence);
    const QString check = "<code>vis2hap verify " +
                          QString::fromStdString(protocols::escapedMarkup(protocols::shellWord(printed.study))) + " --against " +
                          QString::fromStdString(head) + "</code>";
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
           "body{font:14pt 'DejaVu Sans',sans-serif;margin:15mm;color:#000;background:#fff}\n"
           "h1{font-size:20pt}h2{font-size:15pt;margin-top:10mm}table{border-collapse:collapse}\n"
           "td,th{border:1px solid #000;padding:2mm 5mm;text-align:left}\n"
           ".label{display:inline-block;border:1px dashed #000;padding:6mm 9mm;margin:2mm;font-size:26pt;font-weight:bold}\n"
           ".sheet+.sheet{page-break-before:always}p{max-width:170mm}.foot{font-size:9pt;margin-top:10mm}.blank "
           "td{height:9mm;min-width:25mm}\n"
           "</style></head><body>\n<h1>" +
           protocols::escapedMarkup(title) + "</h1>\n" + body + footOf(printed) + "</body></html>\n";
}

Markup paragraph(const QString& text) { return "<p>" + marked(text) + "</p>\n"; }

Markup headRow(std::initializer_list<QString> captions)
{
    std::string row = "<tr>";
    for (const QString& caption : captions) row += "<th>" + marked(caption) + "</th>";
    return row + "</tr>\n";
}

/// One set of labels. All slots share one set where the pieces are labelled once.
struct LabelSet {
    std::string title;  ///< markup
    protocols::SwatchLabels codes;
};

std::vector<LabelSet> labelSetsOf(const database::StudyFacts& facts, const protocols::Protocol& protocol)
{
    std::vector<LabelSet> sets;
    if (facts.swatches.empty()) return sets;
    if (protocol.swatchCodes == protocols::SwatchCodes::Once)
        return {{marked(SheetText::tr("All participants")), facts.swatches.front()}};
    for (std::size_t slot = 0; slot < facts.swatches.size(); ++slot)
        sets.push_back({marked(SheetText::tr("Place %1").arg(slot + 1)), facts.swatches[slot]});
    return sets;
}

Markup labelsPage(const database::StudyFacts& facts, const std::vector<LabelSet>& sets, const PrintedHead& printed)
{
    std::string body =
        paragraph(SheetText::tr("Cut out the labels. Fix each label to the back of its piece, as the preparation sheet shows."));
    for (const auto& set : sets) {
        body += "<h2>" + set.title + "</h2>\n<div>";
        for (const auto& [fabric, code] : set.codes) body += "<span class=\"label\">" + code + "</span>";
        body += "</div>\n";
    }
    return page(SheetText::tr("%1: labels of the fabric pieces").arg(QString::fromStdString(facts.name)).toStdString(), body,
                printed);
}

Markup preparationPage(const database::StudyFacts& facts, const std::vector<LabelSet>& sets, const PrintedHead& printed)
{
    std::string body =
        paragraph(SheetText::tr("For the person who labels the pieces. The operator of a session only needs the codes."));
    for (const auto& set : sets) {
        body += "<div class=\"sheet\"><h2>" + set.title + "</h2>\n<table>" +
                headRow({SheetText::tr("code"), SheetText::tr("fabric"), SheetText::tr("id")});
        for (const auto& [fabric, code] : set.codes)
            body += "<tr><td><b>" + code + "</b></td><td>" + protocols::escapedMarkup(facts.fabricNames.at(fabric)) +
                    "</td><td>" + protocols::escapedMarkup(fabric.value) + "</td></tr>\n";
        body +=
            "</table>\n" + paragraph(SheetText::tr("You also need sandpaper, silk and a second piece of one fabric, for the two "
                                                   "ends of the scale."));
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

/// Words stand at the ends of the sections, one a step.
int sectionsOf(const protocols::RatingScale& scale)
{
    return scale.labels.size() > 1 ? static_cast<int>(scale.labels.size()) - 1 : scale.sections;
}

/// The line with its equal sections. Only the ends have numbers, because the participant memorises the rest.
Markup scaleDrawing(const protocols::RatingScale& scale, const protocols::Protocol& protocol)
{
    const double width = 900, left = 60;
    std::string svg = "<svg viewBox=\"0 0 1020 190\" width=\"100%\" role=\"img\" aria-label=\"" +
                      protocols::escapedMarkup(participantText(protocol, "card_title")) +
                      "\">"
                      "<line x1=\"60\" y1=\"80\" x2=\"960\" y2=\"80\" stroke=\"#000\" stroke-width=\"5\"/>";
    const int sections = sectionsOf(scale);
    for (int mark = 0; mark <= sections; ++mark) {
        const std::string x = shortest(left + width * mark / sections);
        const bool isEnd = mark == 0 || mark == sections;
        svg += "<line x1=\"" + x + "\" x2=\"" + x + "\" y1=\"" + (isEnd ? "45" : "62") + "\" y2=\"" + (isEnd ? "115" : "98") +
               "\" stroke=\"#000\" stroke-width=\"4\"/>";
    }
    const auto end = [&](double x, protocols::Tenths value, const char* anchor, const std::string& words) {
        return "<text x=\"" + shortest(x) + "\" y=\"30\" font-size=\"32\" font-weight=\"bold\" text-anchor=\"middle\">" +
               spokenNumber(value.inScaleUnits(), protocol) + "</text><text x=\"" + shortest(x) +
               "\" y=\"160\" font-size=\"24\" text-anchor=\"" + anchor + "\">" + protocols::escapedMarkup(words) + "</text>";
    };
    return svg +
           end(left, scale.min, "start", scale.labels.empty() ? participantText(protocol, "scale_low") : scale.labels.front()) +
           end(left + width, scale.max, "end",
               scale.labels.empty() ? participantText(protocol, "scale_high") : scale.labels.back()) +
           "</svg>\n";
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
        body += "<ol start=\"" + shortest(scale.min.inScaleUnits()) + "\">";
        for (const auto& label : scale.labels) body += "<li>" + protocols::escapedMarkup(label) + "</li>";
        body += "</ol>\n";
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
        "<table>" +
        headRow(
            {SheetText::tr("date"), SheetText::tr("participant"), SheetText::tr("operator"), SheetText::tr("head of the log")});
    for (int row = 0; row < rows; ++row) body += "<tr class=\"blank\"><td></td><td></td><td></td><td></td></tr>\n";
    return page(SheetText::tr("%1: sittings").arg(QString::fromStdString(facts.name)).toStdString(), body + "</table>\n",
                printed);
}

/// The sentences, and their order for each slot.
Markup instructionsPage(const database::StudyStore& store, const protocols::Protocol& protocol, const std::string& study,
                        const PrintedHead& printed)
{
    std::string body = paragraph(SheetText::tr("The app shows each sentence at the beginning of its block. Read it aloud.")) +
                       "<table>" + headRow({SheetText::tr("questions"), SheetText::tr("instruction"), SheetText::tr("sentence")});
    for (const auto& phase : protocol.phases)
        for (const auto& instruction : phase.instructions) {
            std::string questions;
            for (const auto& question : phase.questions) questions += (questions.empty() ? "" : ", ") + question.id.value;
            body += "<tr><td>" + protocols::escapedMarkup(questions) + "</td><td>" + instruction.id.value + "</td><td>" +
                    protocols::escapedMarkup(instruction.text) + "</td></tr>\n";
        }
    body += "</table>\n<h2>" + marked(SheetText::tr("Order")) + "</h2>\n<table>" +
            headRow({SheetText::tr("place"), SheetText::tr("instructions")});
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
    return page(SheetText::tr("%1: instructions of the blocks").arg(QString::fromStdString(study)).toStdString(),
                body + "</table>\n", printed);
}

}  // namespace

void writeSheets(const database::StudyStore& store, const std::filesystem::path& out)
{
    const auto facts = store.facts();
    const auto protocol = records::latestProtocolOf(store);
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
    if (const auto cards = cardScalesOf(protocol); !cards.empty())
        write("scale-card.html", scaleCards(facts, protocol, cards, printed));
    if (hasInstructions(protocol)) write("instructions.html", instructionsPage(store, protocol, facts.name, printed));
    draft.putInPlace();
}

}  // namespace study::making
