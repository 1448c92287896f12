#include "reports/documents/report_documents.h"

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "reports/documents/figure_files.h"
#include "reports/documents/report_docx.h"
#include "reports/documents/report_pdf.h"
#include "reports/documents/report_tex.h"
#include "reports/figures/report_figures.h"

namespace reports {
namespace {

/// NAME.pdf for two columns and 88mm/NAME.pdf for one.
void writeFigurePdfs(const Figure& figure, const std::filesystem::path& folder)
{
    writeFigurePdf(figure.svg, figure.caption, folder / (figure.name + ".pdf"), twoColumnsMm);
    writeFigurePdf(figure.narrowSvg, figure.caption, folder / oneColumnFolder / (figure.name + ".pdf"), oneColumnMm);
}

}  // namespace

WriteDocuments allDocuments(const std::function<void(const std::string& line)>& note)
{
    return [note](const ReportDocument& document, const std::filesystem::path& folder) {
        for (const DocumentSection& section : document.sections)
            for (const DocumentItem& item : section.items)
                if (const auto* figure = std::get_if<const Figure*>(&item)) writeFigurePdfs(**figure, folder / "figures");
        protocols::writeWholeFile(folder / "report.tex", reportTex(document), protocols::Sync::Later);
        writeReportPdf(document, folder / "report.pdf");
        std::string whyNot = hasPandoc() ? "" : "pandoc is not installed; apt-get install pandoc, then report again";
        try {
            if (whyNot.empty()) writeReportDocx(document, folder);
        } catch (const protocols::Error& fault) {
            whyNot = fault.what();  // the other documents stand
        }
        if (!whyNot.empty() && note) note("report.docx: not made: " + whyNot);
    };
}

}  // namespace reports
