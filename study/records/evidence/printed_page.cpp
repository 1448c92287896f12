#include "study/records/evidence/printed_page.h"

#include "protocols/files/markup_text.h"

namespace study::records::page {

namespace {

std::string rowOf(const std::vector<std::string>& cells, const char* tag)
{
    std::string row = "<tr>";
    for (const auto& cell : cells) row += std::string("<") + tag + ">" + protocols::escapedMarkup(cell) + "</" + tag + ">";
    return row + "</tr>\n";
}

}  // namespace

std::string sentence(const std::string& text) { return "<p>" + protocols::escapedMarkup(text) + "</p>\n"; }

std::string section(const std::string& heading, const std::string& body)
{
    return "<h2>" + protocols::escapedMarkup(heading) + "</h2>\n" + body;
}

std::string table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows)
{
    std::string text = "<table>\n<thead>" + rowOf(head, "th") + "</thead>\n";
    for (const auto& row : rows) text += rowOf(row, "td");
    return text + "</table>\n";
}

std::string whole(const std::string& title, const std::string& body, const std::string& language)
{
    return "<!DOCTYPE html>\n<html lang=\"" + protocols::escapedMarkup(language) + "\"><head><meta charset=\"utf-8\"><title>" +
           protocols::escapedMarkup(title) +
           "</title><style>\n"
           "body{font:11pt 'DejaVu Sans',sans-serif;margin:15mm;color:#000;background:#fff;max-width:190mm}\n"
           "h1{font-size:17pt}h2{font-size:13pt;margin-top:8mm}table{border-collapse:collapse;width:100%}\n"
           "td,th{border:1px solid #999;padding:1mm 2mm;text-align:left;vertical-align:top;overflow-wrap:anywhere}\n"
           "th{overflow-wrap:normal}\n"
           "tr{page-break-inside:avoid}\n"
           "</style></head><body>\n<h1>" +
           protocols::escapedMarkup(title) + "</h1>\n" + body + "</body></html>\n";
}

}  // namespace study::records::page
