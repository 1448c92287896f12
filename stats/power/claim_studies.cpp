#include "stats/power/claim_studies.h"

#include <cmath>
#include <cstdio>

namespace stats {
namespace {

constexpr double ratingParticipantSd = 0.7, ratingFabricSd = 0.45;  // scale points
constexpr double choiceParticipantSd = 0.5, choiceFabricSd = 0.4;   // log odds

double interactionSd(const ClaimNull& null, double sd, std::size_t condition)
{
    if (!null.isUnequal) return sd;
    return condition == 0 ? 1.2 : 0.3;
}

std::vector<double> deviationsOf(std::size_t count, double sd, Draws& draws)
{
    std::vector<double> values(count);
    for (double& value : values) value = draws.normal(sd);
    return values;
}

void centre(std::vector<double>& values)
{
    double mean = 0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (double& value : values) value -= mean;
}

}  // namespace

std::string ClaimNull::text() const
{
    const std::string what = isChoice ? "choices" : "ratings";
    if (isUnequal) return what + ", interactions of SD 1.2 under one condition and 0.3 under the others";
    char numbers[128];
    std::snprintf(numbers, sizeof numbers, ", interactions of SD %g (participants) and %g (fabrics)", participantSd, fabricSd);
    return what + numbers;
}

double ClaimNull::participantsSd(std::size_t condition) const
{
    return std::hypot(isChoice ? choiceParticipantSd : ratingParticipantSd, interactionSd(*this, participantSd, condition));
}

double ClaimNull::fabricsSd(std::size_t condition) const
{
    return std::hypot(isChoice ? choiceFabricSd : ratingFabricSd, interactionSd(*this, fabricSd, condition));
}

std::vector<ClaimNull> claimNulls()
{
    std::vector<ClaimNull> nulls;
    for (const bool isChoice : {false, true}) {
        for (const double participants : {0.0, 0.5, 1.0})
            for (const double fabrics : {0.0, 0.5, 1.0}) nulls.push_back({isChoice, participants, fabrics, false});
        nulls.push_back({isChoice, 0, 0, true});
    }
    return nulls;
}

AnswerCube drawnStudy(const StudyDesign& design, const ClaimNull& null, Generalisation truth, Draws& draws,
                      const std::function<double(const DrawnCell&)>& answer)
{
    AnswerCube cube(null.isChoice ? AnswerValues::Choices : AnswerValues::Ratings, design.conditions, design.participants,
                    design.fabrics);
    const auto people = deviationsOf(design.participants, null.isChoice ? choiceParticipantSd : ratingParticipantSd, draws),
               fabrics = deviationsOf(design.fabrics, null.isChoice ? choiceFabricSd : ratingFabricSd, draws);
    for (std::size_t c = 0; c < design.conditions; ++c) {
        const auto ofPeople = deviationsOf(design.participants, interactionSd(null, null.participantSd, c), draws);
        auto ofFabrics = deviationsOf(design.fabrics, interactionSd(null, null.fabricSd, c), draws);
        if (truth == Generalisation::TheseFabrics) centre(ofFabrics);
        for (std::size_t p = 0; p < design.participants; ++p)
            for (std::size_t f = 0; f < design.fabrics; ++f)
                cube.at(c, p, f) = answer({c, p, people[p] + fabrics[f] + ofPeople[p] + ofFabrics[f], fabrics[f] + ofFabrics[f]});
    }
    return cube;
}

std::vector<ContrastPair> allPairs(std::size_t conditions)
{
    std::vector<ContrastPair> pairs;
    for (std::size_t a = 0; a < conditions; ++a)
        for (std::size_t b = a + 1; b < conditions; ++b) pairs.emplace_back(a, b);
    return pairs;
}

}  // namespace stats
