#include "study/making/study_sheets.h"

#include <cstdio>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "study/records/stored_study.h"

namespace study::making {

namespace {

using protocols::shortest;

std::string escaped(const std::string& text)
{
    std::string html;
    for (const char c : text)
        html += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    return html;
}

std::string page(const std::string& title, const std::string& body)
{
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(title) +
           "</title><style>\n"
           "body{font:14pt 'DejaVu Sans',sans-serif;margin:15mm;color:#000;background:#fff}\n"
           "h1{font-size:20pt}h2{font-size:15pt;margin-top:10mm}table{border-collapse:collapse}\n"
           "td,th{border:1px solid #000;padding:2mm 5mm;text-align:left}\n"
           ".label{display:inline-block;border:1px dashed #000;padding:6mm 9mm;margin:2mm;font-size:26pt;font-weight:bold}\n"
           ".sheet{page-break-after:always}p{max-width:170mm}\n"
           "</style></head><body>\n<h1>" +
           escaped(title) + "</h1>\n" + body + "</body></html>\n";
}

/// Codes of one set of labels: all slots share one where pieces are labelled once.
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

std::string labelsPage(const database::StudyFacts& facts, const std::vector<LabelSet>& sets)
{
    std::string body = "<p>Cut out and fix each to the back of its piece, as the preparation sheet says.</p>\n";
    for (const auto& set : sets) {
        body += "<h2>" + set.title + "</h2>\n<div>";
        for (const auto& [fabric, code] : set.codes) body += "<span class=\"label\">" + code + "</span>";
        body += "</div>\n";
    }
    return page(facts.name + ": labels of the fabric pieces", body);
}

std::string preparationPage(const database::StudyFacts& facts, const std::vector<LabelSet>& sets)
{
    std::string body = "<p>For the person who labels the pieces. The operator of a session needs the codes alone.</p>\n";
    for (const auto& set : sets) {
        body += "<div class=\"sheet\"><h2>" + set.title + "</h2>\n<table><tr><th>code</th><th>fabric</th><th>id</th></tr>\n";
        for (const auto& [fabric, code] : set.codes)
            body += "<tr><td><b>" + code + "</b></td><td>" + escaped(facts.fabricNames.at(fabric)) + "</td><td>" +
                    escaped(fabric.value) + "</td></tr>\n";
        body += "</table>\n<p>Besides: sandpaper, silk, and a duplicate of one fabric, for the ends of the scale.</p>";
        if (!facts.familiarisation.empty()) {
            body += "<p>For getting to know the display:";
            for (const auto& item : facts.familiarisation)
                body += " " + escaped(item.name) + (&item == &facts.familiarisation.back() ? "." : ",");
            body += "</p>";
        }
        body += "</div>\n";
    }
    return page(facts.name + ": preparation of the fabric pieces", body);
}

/// The line with its equal sections; only the ends carry a number, for the participant memorises the rest.
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
    return svg + end(left, scale.min, "start", scale.labels.empty() ? "unrelated" : escaped(scale.labels.front()).c_str()) +
           end(left + width, scale.max, "end", scale.labels.empty() ? "totally the same" : escaped(scale.labels.back()).c_str()) +
           "</svg>\n";
}

std::string scaleCard(const database::StudyFacts& facts, const protocols::RatingScale& scale)
{
    std::string body = "<p>Please learn this line by heart: you will not see it later.</p>\n" + scaleDrawing(scale);
    if (scale.labels.empty())
        body += "<p><b>" + shortest(scale.min.inScaleUnits()) + "</b> is like sandpaper beside silk. <b>" +
                shortest(scale.max.inScaleUnits()) +
                "</b> is like two pieces of the same fabric. You may say any number between, in steps of " +
                shortest(scale.step.inScaleUnits()) + ".</p>\n";
    else {
        body += "<ol start=\"" + shortest(scale.min.inScaleUnits()) + "\">";
        for (const auto& label : scale.labels) body += "<li>" + escaped(label) + "</li>";
        body += "</ol>\n";
    }
    return page(facts.name + ": the scale", body);
}

}  // namespace

int writeSheets(const database::StudyStore& store, const std::filesystem::path& out)
{
    const auto facts = store.facts();
    const auto protocol = records::protocolOf(facts);
    const auto sets = labelSetsOf(facts, protocol);
    std::error_code failure;
    std::filesystem::create_directories(out, failure);
    if (failure)
        throw protocols::environmentFault(
            {"cannot make the folder (" + failure.message() + ")", out.string(), "a writable place", "choose another one"});
    protocols::writeWholeFile(out / "labels.html", labelsPage(facts, sets));
    protocols::writeWholeFile(out / "preparation.html", preparationPage(facts, sets));
    if (const auto* scale = memorisedScaleOf(protocol))
        protocols::writeWholeFile(out / "scale-card.html", scaleCard(facts, *scale));
    std::printf("%s: pages to print\n", out.c_str());
    return 0;
}

}  // namespace study::making
