#include "reports/figures/report_figures.h"

#include <iterator>

#include "reports/figures/accuracy_figures.h"
#include "reports/figures/chain_figures.h"
#include "reports/figures/contrasts_figures.h"
#include "reports/figures/matches_figures.h"
#include "reports/figures/participants_figures.h"
#include "reports/figures/ratings_figures.h"
#include "reports/figures/speed_figures.h"
#include "reports/text/file_names.h"

namespace reports {
namespace {

using FigureFamily = std::vector<Figure> (*)(const StudyAnalysis&);

constexpr FigureFamily families[] = {matchesFigures, ratingsFigures,  participantsFigures, contrastsFigures,
                                     speedFigures,   accuracyFigures, chainFigures};

}  // namespace

std::vector<Figure> reportFigures(const StudyAnalysis& analysis)
{
    std::vector<Figure> figures;
    for (const FigureFamily family : families) {
        std::vector<Figure> some = family(analysis);
        std::move(some.begin(), some.end(), std::back_inserter(figures));
    }
    FileNames names;
    for (Figure& figure : figures) figure.name = names.unique(figure.name);
    return figures;
}

}  // namespace reports
