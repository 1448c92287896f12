#include "stats/measured_size.h"

#include <array>

namespace stats {
namespace {

// vis2hap power --calibrate 10000 --json
constexpr std::array table{
    MeasuredSize{"paired t of participants' means", "ratings, all conditions alike for every fabric",
                 Promise::Exact, 532, 0},
    MeasuredSize{"Wilcoxon signed rank, exact", "ratings, all conditions alike for every fabric",
                 Promise::AtMost, 486, 0.048828125},
    MeasuredSize{"sign flips, exact", "ratings, all conditions alike for every fabric",
                 Promise::AtMost, 506, 0.048828125},
    MeasuredSize{"repeated-measures ANOVA, Greenhouse-Geisser", "ratings, all conditions alike for every fabric",
                 Promise::Printed, 141, 0},
    MeasuredSize{"the same, spread of the conditions 1 : 2", "ratings, all conditions alike for every fabric",
                 Promise::Printed, 412, 0},
    MeasuredSize{"Friedman, chi-squared", "ratings, all conditions alike for every fabric",
                 Promise::Printed, 397, 0},
    MeasuredSize{"Friedman, Iman-Davenport F", "ratings, all conditions alike for every fabric",
                 Promise::Printed, 485, 0},
    MeasuredSize{"any of all pairs, paired t after Holm", "ratings, all conditions alike for every fabric",
                 Promise::AtMost, 427, 0},
    MeasuredSize{"TOST at a bound, the design's own spread", "ratings, all conditions alike for every fabric",
                 Promise::AtMost, 454, 0},
    MeasuredSize{"TOST at a bound", "normal differences of SD 0.3 at a bound of +-0.5",
                 Promise::Exact, 495, 0},
    MeasuredSize{"exact binomial against chance, one condition", "choices by guessing",
                 Promise::AtMost, 368, 0.03662005650131001},
    MeasuredSize{"any condition, exact binomial after Holm", "choices by guessing",
                 Promise::AtMost, 254, 0},
    MeasuredSize{"t of participants' shares against chance, one condition", "choices by guessing",
                 Promise::Printed, 506, 0},
    MeasuredSize{"t of participants' shares against chance, all conditions", "choices by guessing",
                 Promise::Printed, 489, 0},
    MeasuredSize{"mixed model, F of condition", "ratings, conditions alike over all fabrics, each fabric having its own differences",
                 Promise::Printed, 509, 0},
    MeasuredSize{"mixed model, t of one difference", "ratings, conditions alike over all fabrics, each fabric having its own differences",
                 Promise::Printed, 520, 0},
    MeasuredSize{"paired t of participants' means", "ratings, conditions alike over all fabrics, each fabric having its own differences",
                 Promise::Shown, 778, 0},
    MeasuredSize{"repeated-measures ANOVA, Greenhouse-Geisser", "ratings, conditions alike over all fabrics, each fabric having its own differences",
                 Promise::Shown, 566, 0},
    MeasuredSize{"logistic mixed model, likelihood ratio", "choices, all conditions alike, above chance, participants and fabrics differing",
                 Promise::Printed, 481, 0},
    MeasuredSize{"Cochran's Q", "choices, all conditions alike, above chance, participants and fabrics differing",
                 Promise::Printed, 457, 0},
    MeasuredSize{"McNemar, exact", "choices, all conditions alike, above chance, participants and fabrics differing",
                 Promise::AtMost, 327, 0},
    MeasuredSize{"paired t of participants' shares", "choices, all conditions alike, above chance, participants and fabrics differing",
                 Promise::Printed, 473, 0},
};

}  // namespace

std::span<const MeasuredSize> measuredSizes() { return table; }

}  // namespace stats
