// Figures as files for papers: PDF at the widths of one and of two columns, PNG for text documents.
#pragma once

#include <filesystem>

#include "reports/figures/figure.h"

namespace reports {

/// Widths of figures in journals, mm.
inline constexpr double oneColumnMm = 88, twoColumnsMm = 180;

/// Writes a vector PDF of one page that is as large as the figure. Throws environmentFault where it cannot write.
void writeFigurePdf(const std::string& svg, const std::string& caption, const std::filesystem::path& file, double widthMm);

/// Writes a PNG at 300 dpi of `widthMm`.
void writeFigurePng(const Figure& figure, const std::filesystem::path& file, double widthMm = twoColumnsMm);

}  // namespace reports
