// The exact permutation p of Friedman's test for small designs, ties included: within each block all
// orders of its own mid-ranks are equally likely.
#pragma once

#include "stats/kernels/block_table.h"
#include "stats/kernels/value.h"

namespace stats {

struct ExactFriedman {
    Value p;  ///< P(statistic >= observed); undefined with a reason for refused tables and large designs
    Value logP;
};

/// Up to 7 conditions, and as many blocks as about a second allows.
ExactFriedman exactFriedman(const BlockTable& table);

}  // namespace stats
