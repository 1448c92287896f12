// Draws the order in which each participant gets the renderings of one phase, and the instructions of its blocks.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/random.h"

namespace protocols {

/// The label of a presentation beside those of the conditions (a catch trial, an anchor), wherever labels are balanced.
constexpr int additionalLabel = -1;

/// A label (an unnamed condition) and a fabric; both count from 0.
struct Rendering {
    int label = 0;
    int fabric = 0;
    bool operator==(const Rendering&) const = default;
};

struct StudySize {
    int participants = 1;
    int labels = 1;
    int fabrics = 1;
};

/// With two kinds of labels or fabrics, an order without repeats alternates: who knows one place knows them all. So there a
/// repeat is a pair like any other.
constexpr bool mayRepeat(int kinds) { return kinds <= 2; }

/// Ordered pairs of neighbours that an order may have.
constexpr std::int64_t pairKinds(int kinds) { return std::int64_t{kinds} * (mayRepeat(kinds) ? kinds : kinds - 1); }

/// What is even in the order of the fabrics.
enum class FabricOrder {
    Even,   ///< pairs and stretches, as for labels: where the operator lays the fabric anyway
    Drawn,  ///< nothing: where the fabric is what a choice must find. Every rule would be knowledge about true pieces.
};

/// [participant][position]: each rendering once per participant. Over the study, ordered pairs of different labels and of
/// different fabrics follow one another equally often, and none repeats immediately, except as mayRepeat() says. Each label is
/// equally frequent in each stretch of `labels` positions, each fabric in each stretch of `fabrics` positions, against practice
/// and fatigue. Where this is impossible, a bounded search comes as close as it can. Fabrics that are drawn only do not repeat.
std::vector<std::vector<Rendering>> drawRunningOrders(const StudySize& size, FabricOrder fabrics, Random& random);

/// [participant][place]: the number of the instruction, from 0. Each instruction stands equally often at each place and follows
/// each other one equally often, as far as the number of participants allows (Williams 1949, Aust J Chem 2, 149): a cycle has
/// `instructions` orders, or twice as many where that number is odd. The orders of a cycle are shuffled among participants.
std::vector<std::vector<int>> drawInstructionOrders(int participants, int instructions, Random& random);

}  // namespace protocols
