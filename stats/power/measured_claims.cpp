#include "stats/power/measured_claims.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace stats {
namespace {

constexpr std::string_view contrastThese = "contrast, these fabrics";
constexpr std::string_view anyContrastThese = "any contrast of all pairs, these fabrics";
constexpr std::string_view contrastAlike = contrastOfFabricsLikeThese;
constexpr std::string_view anyContrastAlike = anyContrastOfFabricsLikeThese;
constexpr std::string_view equivalenceAlike = "equivalence at a bound, fabrics like these";
constexpr std::string_view chanceAlike = "one condition above chance, fabrics like these";
constexpr std::string_view anyChanceAlike = "any condition above chance, fabrics like these";
constexpr std::string_view participantMeansAlike = participantMeansOfSampledFabrics;
constexpr std::string_view cochranAlike = cochranOfSampledFabrics;

constexpr std::string_view ratingsNoneNone = "ratings, interactions of SD 0 (participants) and 0 (fabrics)";
constexpr std::string_view ratingsNoneHalf = "ratings, interactions of SD 0 (participants) and 0.5 (fabrics)";
constexpr std::string_view ratingsNoneOne = "ratings, interactions of SD 0 (participants) and 1 (fabrics)";
constexpr std::string_view ratingsHalfNone = "ratings, interactions of SD 0.5 (participants) and 0 (fabrics)";
constexpr std::string_view ratingsHalfHalf = "ratings, interactions of SD 0.5 (participants) and 0.5 (fabrics)";
constexpr std::string_view ratingsHalfOne = "ratings, interactions of SD 0.5 (participants) and 1 (fabrics)";
constexpr std::string_view ratingsOneNone = "ratings, interactions of SD 1 (participants) and 0 (fabrics)";
constexpr std::string_view ratingsOneHalf = "ratings, interactions of SD 1 (participants) and 0.5 (fabrics)";
constexpr std::string_view ratingsOneOne = "ratings, interactions of SD 1 (participants) and 1 (fabrics)";
constexpr std::string_view ratingsUnequal = "ratings, interactions of SD 1.2 under one condition and 0.3 under the others";
constexpr std::string_view choicesNoneNone = "choices, interactions of SD 0 (participants) and 0 (fabrics)";
constexpr std::string_view choicesNoneHalf = "choices, interactions of SD 0 (participants) and 0.5 (fabrics)";
constexpr std::string_view choicesNoneOne = "choices, interactions of SD 0 (participants) and 1 (fabrics)";
constexpr std::string_view choicesHalfNone = "choices, interactions of SD 0.5 (participants) and 0 (fabrics)";
constexpr std::string_view choicesHalfHalf = "choices, interactions of SD 0.5 (participants) and 0.5 (fabrics)";
constexpr std::string_view choicesHalfOne = "choices, interactions of SD 0.5 (participants) and 1 (fabrics)";
constexpr std::string_view choicesOneNone = "choices, interactions of SD 1 (participants) and 0 (fabrics)";
constexpr std::string_view choicesOneHalf = "choices, interactions of SD 1 (participants) and 0.5 (fabrics)";
constexpr std::string_view choicesOneOne = "choices, interactions of SD 1 (participants) and 1 (fabrics)";
constexpr std::string_view choicesUnequal = "choices, interactions of SD 1.2 under one condition and 0.3 under the others";

// vis2hap power --calibrate 10000 --json
constexpr std::array claimTable{
    MeasuredSize{contrastThese, ratingsNoneNone, Promise::Printed, 485, 0},
    MeasuredSize{anyContrastThese, ratingsNoneNone, Promise::Printed, 438, 0},
    MeasuredSize{contrastAlike, ratingsNoneNone, Promise::Printed, 199, 0},
    MeasuredSize{anyContrastAlike, ratingsNoneNone, Promise::Printed, 141, 0},
    MeasuredSize{equivalenceAlike, ratingsNoneNone, Promise::Printed, 234, 0},
    MeasuredSize{participantMeansAlike, ratingsNoneNone, Promise::Shown, 514, 0},
    MeasuredSize{contrastThese, ratingsNoneHalf, Promise::Printed, 482, 0},
    MeasuredSize{anyContrastThese, ratingsNoneHalf, Promise::Printed, 427, 0},
    MeasuredSize{contrastAlike, ratingsNoneHalf, Promise::Printed, 465, 0},
    MeasuredSize{anyContrastAlike, ratingsNoneHalf, Promise::Printed, 554, 0},
    MeasuredSize{equivalenceAlike, ratingsNoneHalf, Promise::Printed, 203, 0},
    MeasuredSize{participantMeansAlike, ratingsNoneHalf, Promise::Shown, 2817, 0},
    MeasuredSize{contrastThese, ratingsNoneOne, Promise::Printed, 477, 0},
    MeasuredSize{anyContrastThese, ratingsNoneOne, Promise::Printed, 447, 0},
    MeasuredSize{contrastAlike, ratingsNoneOne, Promise::Printed, 557, 0},
    MeasuredSize{anyContrastAlike, ratingsNoneOne, Promise::Printed, 487, 0},
    MeasuredSize{equivalenceAlike, ratingsNoneOne, Promise::Printed, 16, 0},
    MeasuredSize{participantMeansAlike, ratingsNoneOne, Promise::Shown, 5374, 0},
    MeasuredSize{contrastThese, ratingsHalfNone, Promise::Printed, 530, 0},
    MeasuredSize{anyContrastThese, ratingsHalfNone, Promise::Printed, 482, 0},
    MeasuredSize{contrastAlike, ratingsHalfNone, Promise::Printed, 409, 0},
    MeasuredSize{anyContrastAlike, ratingsHalfNone, Promise::Printed, 299, 0},
    MeasuredSize{equivalenceAlike, ratingsHalfNone, Promise::Printed, 264, 0},
    MeasuredSize{participantMeansAlike, ratingsHalfNone, Promise::Shown, 524, 0},
    MeasuredSize{contrastThese, ratingsHalfHalf, Promise::Printed, 522, 0},
    MeasuredSize{anyContrastThese, ratingsHalfHalf, Promise::Printed, 487, 0},
    MeasuredSize{contrastAlike, ratingsHalfHalf, Promise::Printed, 472, 0},
    MeasuredSize{anyContrastAlike, ratingsHalfHalf, Promise::Printed, 234, 0},
    MeasuredSize{equivalenceAlike, ratingsHalfHalf, Promise::Printed, 53, 0},
    MeasuredSize{participantMeansAlike, ratingsHalfHalf, Promise::Shown, 1401, 0},
    MeasuredSize{contrastThese, ratingsHalfOne, Promise::Printed, 530, 0},
    MeasuredSize{anyContrastThese, ratingsHalfOne, Promise::Printed, 473, 0},
    MeasuredSize{contrastAlike, ratingsHalfOne, Promise::Printed, 571, 0},
    MeasuredSize{anyContrastAlike, ratingsHalfOne, Promise::Printed, 446, 0},
    MeasuredSize{equivalenceAlike, ratingsHalfOne, Promise::Printed, 5, 0},
    MeasuredSize{participantMeansAlike, ratingsHalfOne, Promise::Shown, 3233, 0},
    MeasuredSize{contrastThese, ratingsOneNone, Promise::Printed, 518, 0},
    MeasuredSize{anyContrastThese, ratingsOneNone, Promise::Printed, 475, 0},
    MeasuredSize{contrastAlike, ratingsOneNone, Promise::Printed, 515, 0},
    MeasuredSize{anyContrastAlike, ratingsOneNone, Promise::Printed, 372, 0},
    MeasuredSize{equivalenceAlike, ratingsOneNone, Promise::Printed, 18, 0},
    MeasuredSize{participantMeansAlike, ratingsOneNone, Promise::Shown, 510, 0},
    MeasuredSize{contrastThese, ratingsOneHalf, Promise::Printed, 521, 0},
    MeasuredSize{anyContrastThese, ratingsOneHalf, Promise::Printed, 477, 0},
    MeasuredSize{contrastAlike, ratingsOneHalf, Promise::Printed, 518, 0},
    MeasuredSize{anyContrastAlike, ratingsOneHalf, Promise::Printed, 321, 0},
    MeasuredSize{equivalenceAlike, ratingsOneHalf, Promise::Printed, 3, 0},
    MeasuredSize{participantMeansAlike, ratingsOneHalf, Promise::Shown, 801, 0},
    MeasuredSize{contrastThese, ratingsOneOne, Promise::Printed, 522, 0},
    MeasuredSize{anyContrastThese, ratingsOneOne, Promise::Printed, 480, 0},
    MeasuredSize{contrastAlike, ratingsOneOne, Promise::Printed, 551, 0},
    MeasuredSize{anyContrastAlike, ratingsOneOne, Promise::Printed, 453, 0},
    MeasuredSize{equivalenceAlike, ratingsOneOne, Promise::Printed, 0, 0},
    MeasuredSize{participantMeansAlike, ratingsOneOne, Promise::Shown, 1667, 0},
    MeasuredSize{contrastThese, ratingsUnequal, Promise::Printed, 549, 0},
    MeasuredSize{anyContrastThese, ratingsUnequal, Promise::Printed, 412, 0},
    MeasuredSize{contrastAlike, ratingsUnequal, Promise::Printed, 529, 0},
    MeasuredSize{anyContrastAlike, ratingsUnequal, Promise::Printed, 304, 0},
    MeasuredSize{equivalenceAlike, ratingsUnequal, Promise::Printed, 0, 0},
    MeasuredSize{participantMeansAlike, ratingsUnequal, Promise::Shown, 1607, 0},
    MeasuredSize{contrastAlike, choicesNoneNone, Promise::Printed, 202, 0},
    MeasuredSize{anyContrastAlike, choicesNoneNone, Promise::Printed, 142, 0},
    MeasuredSize{chanceAlike, choicesNoneNone, Promise::Printed, 239, 0},
    MeasuredSize{anyChanceAlike, choicesNoneNone, Promise::Printed, 126, 0},
    MeasuredSize{participantMeansAlike, choicesNoneNone, Promise::Shown, 520, 0},
    MeasuredSize{cochranAlike, choicesNoneNone, Promise::Shown, 527, 0},
    MeasuredSize{contrastAlike, choicesNoneHalf, Promise::Printed, 301, 0},
    MeasuredSize{anyContrastAlike, choicesNoneHalf, Promise::Printed, 354, 0},
    MeasuredSize{chanceAlike, choicesNoneHalf, Promise::Printed, 284, 0},
    MeasuredSize{anyChanceAlike, choicesNoneHalf, Promise::Printed, 150, 0},
    MeasuredSize{participantMeansAlike, choicesNoneHalf, Promise::Shown, 990, 0},
    MeasuredSize{cochranAlike, choicesNoneHalf, Promise::Shown, 2217, 0},
    MeasuredSize{contrastAlike, choicesNoneOne, Promise::Printed, 391, 0},
    MeasuredSize{anyContrastAlike, choicesNoneOne, Promise::Printed, 557, 0},
    MeasuredSize{chanceAlike, choicesNoneOne, Promise::Printed, 285, 0},
    MeasuredSize{anyChanceAlike, choicesNoneOne, Promise::Printed, 163, 0},
    MeasuredSize{participantMeansAlike, choicesNoneOne, Promise::Shown, 2189, 0},
    MeasuredSize{cochranAlike, choicesNoneOne, Promise::Shown, 6193, 0},
    MeasuredSize{contrastAlike, choicesHalfNone, Promise::Printed, 272, 0},
    MeasuredSize{anyContrastAlike, choicesHalfNone, Promise::Printed, 299, 0},
    MeasuredSize{chanceAlike, choicesHalfNone, Promise::Printed, 257, 0},
    MeasuredSize{anyChanceAlike, choicesHalfNone, Promise::Printed, 120, 0},
    MeasuredSize{participantMeansAlike, choicesHalfNone, Promise::Shown, 491, 0},
    MeasuredSize{cochranAlike, choicesHalfNone, Promise::Shown, 1527, 0},
    MeasuredSize{contrastAlike, choicesHalfHalf, Promise::Printed, 322, 0},
    MeasuredSize{anyContrastAlike, choicesHalfHalf, Promise::Printed, 395, 0},
    MeasuredSize{chanceAlike, choicesHalfHalf, Promise::Printed, 286, 0},
    MeasuredSize{anyChanceAlike, choicesHalfHalf, Promise::Printed, 161, 0},
    MeasuredSize{participantMeansAlike, choicesHalfHalf, Promise::Shown, 879, 0},
    MeasuredSize{cochranAlike, choicesHalfHalf, Promise::Shown, 3272, 0},
    MeasuredSize{contrastAlike, choicesHalfOne, Promise::Printed, 433, 0},
    MeasuredSize{anyContrastAlike, choicesHalfOne, Promise::Printed, 452, 0},
    MeasuredSize{chanceAlike, choicesHalfOne, Promise::Printed, 298, 0},
    MeasuredSize{anyChanceAlike, choicesHalfOne, Promise::Printed, 154, 0},
    MeasuredSize{participantMeansAlike, choicesHalfOne, Promise::Shown, 1876, 0},
    MeasuredSize{cochranAlike, choicesHalfOne, Promise::Shown, 6548, 0},
    MeasuredSize{contrastAlike, choicesOneNone, Promise::Printed, 363, 0},
    MeasuredSize{anyContrastAlike, choicesOneNone, Promise::Printed, 325, 0},
    MeasuredSize{chanceAlike, choicesOneNone, Promise::Printed, 283, 0},
    MeasuredSize{anyChanceAlike, choicesOneNone, Promise::Printed, 131, 0},
    MeasuredSize{participantMeansAlike, choicesOneNone, Promise::Shown, 509, 0},
    MeasuredSize{cochranAlike, choicesOneNone, Promise::Shown, 4486, 0},
    MeasuredSize{contrastAlike, choicesOneHalf, Promise::Printed, 357, 0},
    MeasuredSize{anyContrastAlike, choicesOneHalf, Promise::Printed, 282, 0},
    MeasuredSize{chanceAlike, choicesOneHalf, Promise::Printed, 286, 0},
    MeasuredSize{anyChanceAlike, choicesOneHalf, Promise::Printed, 156, 0},
    MeasuredSize{participantMeansAlike, choicesOneHalf, Promise::Shown, 699, 0},
    MeasuredSize{cochranAlike, choicesOneHalf, Promise::Shown, 5470, 0},
    MeasuredSize{contrastAlike, choicesOneOne, Promise::Printed, 418, 0},
    MeasuredSize{anyContrastAlike, choicesOneOne, Promise::Printed, 294, 0},
    MeasuredSize{chanceAlike, choicesOneOne, Promise::Printed, 289, 0},
    MeasuredSize{anyChanceAlike, choicesOneOne, Promise::Printed, 162, 0},
    MeasuredSize{participantMeansAlike, choicesOneOne, Promise::Shown, 1317, 0},
    MeasuredSize{cochranAlike, choicesOneOne, Promise::Shown, 7279, 0},
    MeasuredSize{contrastAlike, choicesUnequal, Promise::Printed, 407, 0},
    MeasuredSize{anyContrastAlike, choicesUnequal, Promise::Printed, 326, 0},
    MeasuredSize{chanceAlike, choicesUnequal, Promise::Printed, 271, 0},
    MeasuredSize{anyChanceAlike, choicesUnequal, Promise::Printed, 145, 0},
    MeasuredSize{participantMeansAlike, choicesUnequal, Promise::Shown, 1119, 0},
    MeasuredSize{cochranAlike, choicesUnequal, Promise::Shown, 2504, 0},
};

double rateUnder(std::string_view test, const ClaimNull& null)
{
    const std::string truth = null.text();
    const auto row = std::find_if(claimTable.begin(), claimTable.end(),
                                  [&](const MeasuredSize& size) { return size.test == test && size.truth == truth; });
    assert(row != claimTable.end() && "the test was measured under this null");
    return row->rate();
}

/// The measured SD below, and the share of the way to the next one.
struct GridPlace {
    double low;
    double part;
};

GridPlace placeOf(double sd)
{
    const double inside = std::clamp(sd, 0.0, 1.0);
    return inside < 0.5 ? GridPlace{0, inside / 0.5} : GridPlace{0.5, (inside - 0.5) / 0.5};
}

}  // namespace

std::span<const MeasuredSize> measuredClaims() { return claimTable; }

double falseClaimRate(std::string_view test, const ClaimNull& null)
{
    const GridPlace people = placeOf(null.participantSd), fabrics = placeOf(null.fabricSd);
    const auto at = [&](double participantSd, double fabricSd) {
        return rateUnder(test, {null.isChoice, participantSd, fabricSd, false});
    };
    const auto along = [&](double participantSd) {
        return (1 - fabrics.part) * at(participantSd, fabrics.low) + fabrics.part * at(participantSd, fabrics.low + 0.5);
    };
    return (1 - people.part) * along(people.low) + people.part * along(people.low + 0.5);
}

}  // namespace stats
