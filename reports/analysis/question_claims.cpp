#include "reports/analysis/question_claims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "reports/cells/common_units.h"
#include "reports/data/design_limits.h"
#include "stats/kernels/decimal_grid.h"

namespace reports {
namespace {

using stats::AnswerCube;
using stats::ContrastPair;
using stats::Generalisation;

std::size_t placeOfCondition(const StudyData& data, const std::string& condition)
{
    return static_cast<std::size_t>(std::find(data.conditions.begin(), data.conditions.end(), condition) -
                                    data.conditions.begin());
}

/// The planned contrasts, the primary one first; all pairs where none is planned, unless they are too many.
std::vector<ContrastPair> familyOf(const StudyData& data)
{
    std::vector<ContrastPair> family;
    const std::size_t count = data.conditions.size();
    for (const auto& [a, b] : data.planned)
        if (placeOfCondition(data, a) < count && placeOfCondition(data, b) < count)
            family.emplace_back(placeOfCondition(data, a), placeOfCondition(data, b));
    if (!family.empty() || !comparesAllPairs(data)) return family;
    for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = a + 1; b < count; ++b) family.emplace_back(a, b);
    return family;
}

std::vector<stats::Value> meansByFabric(const AnswerCube& cube, const ContrastPair& contrast)
{
    const stats::CrossedTable table = cube.differences(contrast.first, contrast.second);
    std::vector<std::vector<double>> differences(cube.fabrics());
    for (std::size_t cell = 0; cell < table.values.size(); ++cell)
        if (!std::isnan(table.values[cell])) differences[cell % cube.fabrics()].push_back(table.values[cell]);
    std::vector<stats::Value> means;
    for (const std::vector<double>& ofFabric : differences) means.push_back(stats::meanOf(ofFabric));
    return means;
}

std::map<std::string, std::size_t> fabricPlacesOf(const StudyData& data)
{
    std::map<std::string, std::size_t> places;
    for (const std::string& fabric : data.fabrics) places.emplace(fabric, places.size());
    return places;
}

/// Each contrast takes the repetitions that were answered under both of its conditions.
void compareCommonUnits(AnswerCube& cube, const StudyData& data, const AnswerCells& cells, const std::string& question,
                        const std::vector<ContrastPair>& contrasts)
{
    if (cells.mostAnswers(question) < 2) return;
    const auto places = fabricPlacesOf(data);
    const std::size_t count = cube.participants() * cube.fabrics();
    const std::vector<double> none(count, std::numeric_limits<double>::quiet_NaN());
    for (const auto& [a, b] : contrasts) {
        const CommonUnits units(cells, question, {data.conditions[a], data.conditions[b]});
        stats::CrossedTable ofA{cube.participants(), cube.fabrics(), none}, ofB = ofA;
        for (std::size_t p = 0; p < cube.participants(); ++p)
            for (const CommonUnits::FabricMeans& fabric : units.fabrics(cells.participants()[p])) {
                const std::size_t cell = p * cube.fabrics() + places.at(fabric.fabric);
                if (fabric.means[0].exists()) ofA.values[cell] = *fabric.means[0];
                if (fabric.means[1].exists()) ofB.values[cell] = *fabric.means[1];
            }
        cube.setComparable(a, b, std::move(ofA), std::move(ofB));
    }
}

/// The claims of one family for one generalisation, with each fabric and each participant left out in turn.
class Family {
public:
    Family(const StudyData& data, const AnswerCells& cells, const AnswerCube& cube, const std::vector<ContrastPair>& contrasts,
           const std::optional<stats::Bounds>& bounds, Depth depth)
        : m_data(data), m_cells(cells), m_cube(cube), m_contrasts(contrasts), m_bounds(bounds), m_depth(depth)
    {
    }

    std::vector<ContrastFinding> findings(Generalisation generalisation) const
    {
        std::vector<ContrastFinding> findings;
        for (stats::ContrastClaim& claim : stats::contrastClaims(m_cube, m_contrasts, m_bounds, generalisation)) {
            const auto contrast = std::pair(m_data.conditions[claim.a], m_data.conditions[claim.b]);
            // Answers from elsewhere may lack the conditions of the protocol: then all pairs are tested, and none is planned.
            const bool isPlanned = std::ranges::find(m_data.planned, contrast) != m_data.planned.end();
            findings.push_back({m_data.conditions[claim.a],
                                m_data.conditions[claim.b],
                                isPlanned,
                                isPlanned && contrast == m_data.planned.front(),
                                generalisation,
                                std::move(claim),
                                {},
                                {},
                                {}});
            findings.back().byFabric = meansByFabric(m_cube, m_contrasts[findings.size() - 1]);
        }
        if (m_depth == Depth::Quick || m_contrasts.size() > mostContrastsLeftOut) return findings;
        for (std::size_t f = 0; f < m_cube.fabrics() && m_cube.fabrics() > 1; ++f)
            addWithout(findings, generalisation, m_cube.withoutFabric(f), m_data.fabrics[f], &ContrastFinding::withoutFabric);
        if (m_cube.participants() > mostLeftOut) return findings;
        for (std::size_t p = 0; p < m_cube.participants() && m_cube.participants() > 1; ++p)
            addWithout(findings, generalisation, m_cube.withoutParticipant(p), m_cells.participants()[p],
                       &ContrastFinding::withoutParticipant);
        return findings;
    }

private:
    void addWithout(std::vector<ContrastFinding>& findings, Generalisation generalisation, const AnswerCube& rest,
                    const std::string& name, std::vector<LeftOneOut> ContrastFinding::*list) const
    {
        const auto claims = stats::contrastClaims(rest, m_contrasts, m_bounds, generalisation);
        for (std::size_t i = 0; i < claims.size(); ++i)
            (findings[i].*list).push_back({name, claims[i].mean.estimate, claims[i].mean.ci90, claims[i].verdict});
    }

    const StudyData& m_data;
    const AnswerCells& m_cells;
    const AnswerCube& m_cube;
    const std::vector<ContrastPair>& m_contrasts;
    const std::optional<stats::Bounds>& m_bounds;
    Depth m_depth;
};

stats::FTest testOf(const stats::RepeatedMeasuresAnova& anova)
{
    if (anova.pGg.exists() && anova.epsilonGg.exists())
        return {"", anova.f, *anova.df1 * *anova.epsilonGg, *anova.df2 * *anova.epsilonGg, anova.pGg, anova.logPGg};
    const std::string why = anova.pGg.exists() ? anova.epsilonGg.why() : anova.pGg.why();
    const stats::Value none = stats::Value::undefined(why);
    return {why, none, none, none, none, none};
}

}  // namespace

stats::AnswerCube answerCube(const StudyData& data, const AnswerCells& cells, const std::string& question,
                             stats::AnswerValues kind)
{
    const auto fabrics = fabricPlacesOf(data);
    AnswerCube cube(kind, data.conditions.size(), cells.participants().size(), fabrics.size());
    for (std::size_t c = 0; c < data.conditions.size(); ++c)
        for (const AnswerCells::CellMean& cell : cells.cellMeans(question, data.conditions[c]))
            cube.at(c, cell.participant, fabrics.at(cell.first->fabric)) = cell.mean;
    return cube;
}

QuestionClaims claimsOf(const StudyData& data, const AnswerCells& cells, const std::string& question,
                        std::optional<int> alternatives, const stats::RepeatedMeasuresAnova& anova,
                        const stats::RatingModel& model, Depth depth, const std::vector<std::string>& noChance)
{
    QuestionClaims claims;
    if (!alternatives) claims.bounds = data.equivalenceBounds;
    AnswerCube cube =
        answerCube(data, cells, question, alternatives ? stats::AnswerValues::Choices : stats::AnswerValues::Ratings);
    const std::vector<ContrastPair> contrasts = familyOf(data);
    compareCommonUnits(cube, data, cells, question, contrasts);
    const Family family(data, cells, cube, contrasts, claims.bounds, depth);
    const std::vector<ContrastFinding> these = family.findings(Generalisation::TheseFabrics),
                                       alike = family.findings(Generalisation::FabricsLikeThese);
    for (std::size_t i = 0; i < these.size(); ++i) {
        claims.contrasts.push_back(these[i]);
        claims.contrasts.push_back(alike[i]);
    }
    if (alternatives) {
        const double chance = 1.0 / *alternatives;
        const auto ofThese = stats::chanceClaims(cube, chance, Generalisation::TheseFabrics, noChance),
                   ofAlike = stats::chanceClaims(cube, chance, Generalisation::FabricsLikeThese, noChance);
        for (std::size_t c = 0; c < data.conditions.size(); ++c) {
            claims.aboveChance.push_back({data.conditions[c], Generalisation::TheseFabrics, ofThese[c]});
            claims.aboveChance.push_back({data.conditions[c], Generalisation::FabricsLikeThese, ofAlike[c]});
        }
    }
    claims.omnibus = {{Generalisation::TheseFabrics, testOf(anova)},
                      {Generalisation::FabricsLikeThese, stats::conditionForOthers(model)}};
    return claims;
}

bool arePlanned(const QuestionClaims& claims) { return !claims.contrasts.empty() && claims.contrasts.front().planned; }

std::string nameOf(Generalisation generalisation)
{
    return generalisation == Generalisation::TheseFabrics ? "these_fabrics" : "fabrics_like_these";
}

}  // namespace reports
