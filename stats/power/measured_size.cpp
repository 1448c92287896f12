#include "stats/power/measured_size.h"

#include <array>

namespace stats {
namespace {

constexpr std::string_view alike = "ratings, all conditions alike for every fabric";
constexpr std::string_view narrow = "normal differences of SD 0.3 at a bound of +-0.5";
constexpr std::string_view guessing = "choices by guessing";
constexpr std::string_view sampled = "ratings, conditions alike over all fabrics, each fabric having its own differences";
constexpr std::string_view alikeChoices = "choices, all conditions alike, above chance, participants and fabrics differing";

// vis2hap power --calibrate 10000 --json
constexpr std::array measuredTable{
    MeasuredSize{"paired t of participants' means", alike, Promise::Exact, 532, 0},
    MeasuredSize{"Wilcoxon signed rank, exact", alike, Promise::AtMost, 486, 0.048828125},
    MeasuredSize{"sign flips, exact", alike, Promise::AtMost, 506, 0.048828125},
    MeasuredSize{"repeated-measures ANOVA, Greenhouse-Geisser", alike, Promise::Printed, 141, 0},
    MeasuredSize{"the same, spread of the conditions 1 : 2", alike, Promise::Printed, 412, 0},
    MeasuredSize{"Friedman, chi-squared", alike, Promise::Printed, 397, 0},
    MeasuredSize{"Friedman, Iman-Davenport F", alike, Promise::Printed, 485, 0},
    MeasuredSize{"any of all pairs, paired t after Holm", alike, Promise::AtMost, 427, 0},
    MeasuredSize{"TOST at a bound, the design's own spread", alike, Promise::AtMost, 454, 0},
    MeasuredSize{"TOST at a bound", narrow, Promise::Exact, 495, 0},
    MeasuredSize{"exact binomial against chance, one condition", guessing, Promise::AtMost, 368, 0.03662005650131001},
    MeasuredSize{"any condition, exact binomial after Holm", guessing, Promise::AtMost, 254, 0},
    MeasuredSize{"t of participants' shares against chance, one condition", guessing, Promise::Printed, 506, 0},
    MeasuredSize{"t of participants' shares against chance, all conditions", guessing, Promise::Printed, 489, 0},
    MeasuredSize{"mixed model, F of condition", sampled, Promise::Printed, 509, 0},
    MeasuredSize{"mixed model, t of one difference", sampled, Promise::Printed, 520, 0},
    MeasuredSize{"paired t of participants' means", sampled, Promise::Shown, 778, 0},
    MeasuredSize{"repeated-measures ANOVA, Greenhouse-Geisser", sampled, Promise::Shown, 566, 0},
    MeasuredSize{"logistic mixed model, likelihood ratio", alikeChoices, Promise::Printed, 481, 0},
    MeasuredSize{"Cochran's Q", alikeChoices, Promise::Printed, 457, 0},
    MeasuredSize{"McNemar, exact", alikeChoices, Promise::AtMost, 327, 0},
    MeasuredSize{"paired t of participants' shares", alikeChoices, Promise::Printed, 473, 0},
};

}  // namespace

std::span<const MeasuredSize> measuredSizes() { return measuredTable; }

}  // namespace stats
