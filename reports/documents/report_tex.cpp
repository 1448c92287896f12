#include "reports/documents/report_tex.h"

#include <QXmlStreamReader>

#include "protocols/files/number_text.h"
#include "reports/documents/drawing_painter.h"
#include "reports/documents/html_entities.h"
#include "reports/documents/html_tiles.h"
#include "reports/text/tex_text.h"

namespace reports {
namespace {

/// What LaTeX writes before and after an element.
struct ElementTex {
    const char16_t* name;
    const char* before;
    const char* after;
};

constexpr ElementTex elements[] = {{u"p", "", "\n\n"},
                                   {u"b", "\\textbf{", "}"},
                                   {u"i", "\\emph{", "}"},
                                   {u"em", "\\emph{", "}"},
                                   {u"code", "\\texttt{", "}"},
                                   {u"sub", "\\textsubscript{", "}"},
                                   {u"sup", "\\textsuperscript{", "}"},
                                   {u"br", "\\\\\n", ""},
                                   {u"ul", "\\begin{itemize}\n", "\\end{itemize}\n\n"},
                                   {u"li", "\\item ", "\n"},
                                   {u"summary", "\\paragraph{", "}\n"},
                                   {u"h3", "\\paragraph{", "}\n"}};

const ElementTex* elementNamed(QStringView name)
{
    for (const ElementTex& one : elements)
        if (name == one.name) return &one;
    return nullptr;
}

std::string texOf(const ReportTable* table) { return "\\input{tables/" + table->table.name + ".tex}\n"; }

std::string texOf(const Figure* figure)
{
    const double share = shareOfTextWidth(figure->svg);
    const std::string width = (share < 1 ? protocols::fixed(share, 2) : std::string()) + "\\textwidth";
    return "\\begin{figure}\n\\centering\n\\includegraphics[width=" + width + "]{figures/" + figure->name + ".pdf}\n\\caption{" +
           breakableTex(figure->caption) + "}\n\\label{fig:" + figure->name + "}\n\\end{figure}\n";
}

}  // namespace

std::string texOfHtml(const std::string& html)
{
    QXmlStreamReader xml(asXml(withoutTiles(html)));
    std::string tex;
    int inCode = 0;
    while (!xml.atEnd()) {
        const auto token = xml.readNext();
        const ElementTex* element = elementNamed(xml.name());
        if (token == QXmlStreamReader::StartElement) {
            if (xml.name() == u"code") ++inCode;
            if (element != nullptr) tex += element->before;
        } else if (token == QXmlStreamReader::EndElement) {
            if (xml.name() == u"code") --inCode;
            if (element != nullptr) tex += element->after;
        } else if (token == QXmlStreamReader::Characters) {
            const std::string text = xml.text().toString().toStdString();
            tex += inCode > 0 ? breakableTex(text) : escapedTex(text);
        }
    }
    return tex;
}

std::string reportTex(const ReportDocument& document)
{
    std::string tex =
        "\\documentclass{article}\n\\usepackage[T1]{fontenc}\n\\usepackage{array,booktabs,longtable}\n\\usepackage{graphicx}\n"
        "\\usepackage[margin=30mm]{geometry}\n\\usepackage[hidelinks]{hyperref}\n\\sloppy\n\\title{" +
        breakableTex(document.title) + "}\n\\date{}\n\\begin{document}\n\\maketitle\n\\noindent " + escapedTex(document.lede) +
        "\n\n";
    for (const DocumentNotice& notice : document.notices) tex += "\\noindent " + texOfHtml(notice.html) + "\n\n";
    std::string tags;
    for (const DocumentTag& tag : document.tags) tags += " [" + tag.text + "]";
    for (const DocumentSection& section : document.sections) {
        tex += "\\section{" + escapedTex(section.heading.title + tags) + "}\n" + texOfHtml(section.leadHtml);
        for (const DocumentItem& item : section.items) tex += std::visit([](const auto* one) { return texOf(one); }, item);
        // Floats stay in their section, and LaTeX holds only a few of them.
        tex += texOfHtml(section.endHtml) + "\\clearpage\n";
    }
    return tex + texOfHtml(document.footerHtml) + "\n\\end{document}\n";
}

}  // namespace reports
