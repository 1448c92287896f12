#include "stats/claims/answer_cube.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "stats/kernels/distributions.h"

namespace stats {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

constexpr double interactionAlpha = 0.05;

/// The participants and fabrics that have answers. Empty where one of their answers is missing.
struct CompleteCells {
    std::vector<std::size_t> participants, fabrics;
};

CompleteCells completeCells(const AnswerCube& answers)
{
    std::vector<bool> participantMet(answers.participants()), fabricMet(answers.fabrics());
    for (std::size_t c = 0; c < answers.conditions(); ++c)
        for (std::size_t p = 0; p < answers.participants(); ++p)
            for (std::size_t f = 0; f < answers.fabrics(); ++f)
                if (!std::isnan(answers.at(c, p, f))) participantMet[p] = fabricMet[f] = true;
    CompleteCells cells;
    for (std::size_t p = 0; p < participantMet.size(); ++p)
        if (participantMet[p]) cells.participants.push_back(p);
    for (std::size_t f = 0; f < fabricMet.size(); ++f)
        if (fabricMet[f]) cells.fabrics.push_back(f);
    for (std::size_t c = 0; c < answers.conditions(); ++c)
        for (const std::size_t p : cells.participants)
            for (const std::size_t f : cells.fabrics)
                if (std::isnan(answers.at(c, p, f))) return {};
    return cells;
}

/// Sum of squares of the interaction of condition with the rows of `means`, [conditions x rows]. Each is a mean of `size`
/// answers.
double interactionSquares(const std::vector<double>& means, std::size_t rows, double size)
{
    const std::size_t conditions = means.size() / rows;
    std::vector<double> ofCondition(conditions), ofRow(rows);
    double mean = 0;
    for (std::size_t cell = 0; cell < means.size(); ++cell) {
        ofCondition[cell / rows] += means[cell] / static_cast<double>(rows);
        ofRow[cell % rows] += means[cell] / static_cast<double>(conditions);
        mean += means[cell] / static_cast<double>(means.size());
    }
    double squares = 0;
    for (std::size_t cell = 0; cell < means.size(); ++cell) {
        const double rest = means[cell] - ofCondition[cell / rows] - ofRow[cell % rows] + mean;
        squares += size * rest * rest;
    }
    return squares;
}

}  // namespace

AnswerCube::AnswerCube(AnswerValues kind, std::size_t conditions, std::size_t participants, std::size_t fabrics)
    : m_kind(kind),
      m_conditions(conditions),
      m_participants(participants),
      m_fabrics(fabrics),
      m_values(conditions * participants * fabrics, missing)
{
}

double& AnswerCube::at(std::size_t condition, std::size_t participant, std::size_t fabric)
{
    assert(condition < m_conditions && participant < m_participants && fabric < m_fabrics);
    return m_values[(condition * m_participants + participant) * m_fabrics + fabric];
}

double AnswerCube::at(std::size_t condition, std::size_t participant, std::size_t fabric) const
{
    return m_values[(condition * m_participants + participant) * m_fabrics + fabric];
}

AnswerCube AnswerCube::withoutParticipant(std::size_t participant) const
{
    AnswerCube rest = *this;
    for (std::size_t f = 0; f < m_fabrics; ++f) {
        for (std::size_t c = 0; c < m_conditions; ++c) rest.at(c, participant, f) = missing;
        for (auto& [pair, table] : rest.m_comparable) table.values[participant * m_fabrics + f] = missing;
    }
    return rest;
}

AnswerCube AnswerCube::withoutFabric(std::size_t fabric) const
{
    AnswerCube rest = *this;
    for (std::size_t p = 0; p < m_participants; ++p) {
        for (std::size_t c = 0; c < m_conditions; ++c) rest.at(c, p, fabric) = missing;
        for (auto& [pair, table] : rest.m_comparable) table.values[p * m_fabrics + fabric] = missing;
    }
    return rest;
}

CrossedTable AnswerCube::tableUnder(std::size_t condition) const
{
    const auto first = m_values.begin() + static_cast<std::ptrdiff_t>(condition * m_participants * m_fabrics);
    return {m_participants, m_fabrics, {first, first + static_cast<std::ptrdiff_t>(m_participants * m_fabrics)}};
}

void AnswerCube::setComparable(std::size_t a, std::size_t b, CrossedTable ofA, CrossedTable ofB)
{
    assert(ofA.values.size() == m_participants * m_fabrics && ofB.values.size() == ofA.values.size());
    const CrossedTable cellsOfA = tableUnder(a), cellsOfB = tableUnder(b);
    bool areCells = true;
    for (std::size_t cell = 0; cell < ofA.values.size() && areCells; ++cell) {
        if (std::isnan(cellsOfA.values[cell]) || std::isnan(cellsOfB.values[cell])) continue;
        areCells = ofA.values[cell] == cellsOfA.values[cell] && ofB.values[cell] == cellsOfB.values[cell];
    }
    m_comparable.erase({a, b});
    m_comparable.erase({b, a});
    if (areCells) return;
    m_comparable[{a, b}] = std::move(ofA);
    m_comparable[{b, a}] = std::move(ofB);
}

CrossedTable AnswerCube::comparable(std::size_t condition, std::size_t other) const
{
    const auto found = m_comparable.find({condition, other});
    return found == m_comparable.end() ? tableUnder(condition) : found->second;
}

CrossedTable AnswerCube::differences(std::size_t a, std::size_t b) const
{
    CrossedTable table = comparable(a, b);
    const auto found = m_comparable.find({b, a});
    const double* const other =
        found == m_comparable.end() ? m_values.data() + b * table.values.size() : found->second.values.data();
    for (std::size_t cell = 0; cell < table.values.size(); ++cell) table.values[cell] -= other[cell];
    return table;
}

Degrees degreesOf(const AnswerCube& answers)
{
    if (answers.comparesOtherMeans()) return Degrees::Limited;
    const CompleteCells cells = completeCells(answers);
    const std::size_t conditions = answers.conditions(), participants = cells.participants.size(), fabrics = cells.fabrics.size();
    if (conditions < 2 || participants < 2 || fabrics < 2) return Degrees::Limited;
    double largest = 0;  // F does not depend on the unit, and squares of very large values would overflow
    for (std::size_t c = 0; c < conditions; ++c)
        for (const std::size_t p : cells.participants)
            for (const std::size_t f : cells.fabrics) largest = std::max(largest, std::fabs(answers.at(c, p, f)));
    if (!(largest > 0) || !std::isfinite(largest)) return Degrees::Limited;
    const int exponent = std::ilogb(largest);
    const auto value = [&](std::size_t c, std::size_t p, std::size_t f) {
        return std::ldexp(answers.at(c, cells.participants[p], cells.fabrics[f]), -exponent);
    };
    std::vector<double> ofParticipants(conditions * participants), ofFabrics(conditions * fabrics), ofConditions(conditions);
    for (std::size_t c = 0; c < conditions; ++c)
        for (std::size_t p = 0; p < participants; ++p)
            for (std::size_t f = 0; f < fabrics; ++f) {
                ofParticipants[c * participants + p] += value(c, p, f) / static_cast<double>(fabrics);
                ofFabrics[c * fabrics + f] += value(c, p, f) / static_cast<double>(participants);
                ofConditions[c] += value(c, p, f) / static_cast<double>(participants * fabrics);
            }
    // What participants and fabrics add to each condition is taken off within the condition.
    double squares = 0;
    for (std::size_t c = 0; c < conditions; ++c)
        for (std::size_t p = 0; p < participants; ++p)
            for (std::size_t f = 0; f < fabrics; ++f) {
                const double rest =
                    value(c, p, f) - ofParticipants[c * participants + p] - ofFabrics[c * fabrics + f] + ofConditions[c];
                squares += rest * rest;
            }
    const auto p = static_cast<double>(participants - 1), f = static_cast<double>(fabrics - 1),
               c = static_cast<double>(conditions - 1), residualDegrees = static_cast<double>(conditions) * p * f;
    const double residual = squares / residualDegrees;
    if (!(residual > 0)) return Degrees::Limited;
    const auto isShown = [&](double interaction, double degrees) {
        const double ratio = interaction / degrees / residual;
        return !std::isfinite(ratio) || fisherUpper(ratio, degrees, residualDegrees).p < interactionAlpha;
    };
    const bool ofPeople = isShown(interactionSquares(ofParticipants, participants, f + 1), p * c),
               ofCloth = isShown(interactionSquares(ofFabrics, fabrics, p + 1), f * c);
    return ofPeople || ofCloth ? Degrees::Limited : Degrees::Satterthwaite;
}

}  // namespace stats
