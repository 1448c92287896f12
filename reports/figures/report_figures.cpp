#include "reports/figures/report_figures.h"

#include <iterator>

#include "reports/figures/accuracy_figures.h"
#include "reports/figures/chain_figures.h"
#include "reports/figures/contrasts_figures.h"
#include "reports/figures/fabric_figures.h"
#include "reports/figures/matches_figures.h"
#include "reports/figures/participants_figures.h"
#include "reports/figures/pictures_figures.h"
#include "reports/figures/ratings_figures.h"
#include "reports/figures/speed_figures.h"
#include "reports/text/file_names.h"

namespace reports {
namespace {

using FigureFamily = std::vector<Figure> (*)(const StudyAnalysis&, FigureWidth);

constexpr FigureFamily families[] = {matchesFigures, ratingsFigures,  fabricFigures, participantsFigures, contrastsFigures,
                                     speedFigures,   accuracyFigures, chainFigures,  picturesFigures};

}  // namespace

std::vector<Figure> reportFigures(const StudyAnalysis& analysis)
{
    std::vector<Figure> figures;
    if (analysis.data.blinded) return figures;
    for (const FigureFamily family : families) {
        std::vector<Figure> some = family(analysis, FigureWidth::TwoColumns);
        std::vector<Figure> narrow = family(analysis, FigureWidth::OneColumn);
        for (std::size_t i = 0; i < some.size(); ++i) some[i].narrowSvg = std::move(narrow.at(i).svg);
        std::move(some.begin(), some.end(), std::back_inserter(figures));
    }
    FileNames names;
    for (Figure& figure : figures) figure.name = names.unique(figure.name);
    return figures;
}

}  // namespace reports
