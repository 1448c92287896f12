#include "reports/documents/report_documents.h"

#include "protocols/files/whole_file.h"
#include "reports/documents/figure_files.h"
#include "reports/documents/report_docx.h"
#include "reports/documents/report_pdf.h"
#include "reports/documents/report_tex.h"

namespace reports {

WriteDocuments allDocuments(const std::function<void(const std::string& line)>& note)
{
    return [note](const ReportDocument& document, const std::filesystem::path& folder) {
        for (const DocumentSection& section : document.sections)
            for (const DocumentItem& item : section.items)
                if (const auto* figure = std::get_if<const Figure*>(&item))
                    writeFigurePdf(**figure, folder / "figures" / ((*figure)->name + ".pdf"));
        protocols::writeWholeFile(folder / "report.tex", reportTex(document), protocols::Sync::Later);
        writeReportPdf(document, folder / "report.pdf");
        if (hasPandoc())
            writeReportDocx(document, folder);
        else if (note)
            note("report.docx: not made, because pandoc is not installed (apt-get install pandoc, then report again)");
    };
}

}  // namespace reports
