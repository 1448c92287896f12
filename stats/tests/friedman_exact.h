// Exact permutation p of Friedman's test for small designs, with ties: within each block all orders of its own
// mid-ranks are equally likely.
#pragma once

#include "stats/kernels/block_table.h"
#include "stats/kernels/value.h"

namespace stats {

struct ExactFriedman {
    Value p;  ///< P(statistic >= observed); undefined with a reason for refused tables and large designs
    Value logP;
};

/// Exact test of up to 7 conditions; the number of blocks is limited to about a second of work.
ExactFriedman exactFriedman(const BlockTable& table);

}  // namespace stats
