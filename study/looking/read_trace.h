// Friction records as traces to look at, also those that a data set would refuse: gaps are what is looked for.
#pragma once

#include "study/looking/read_signal.h"

namespace study::looking {

/// CSV with t_s or position_mm (or neither) and normal_n,tangential_n, or mu, or any quantity. What is no number, and
/// friction at a normal force up to 0.05 N, is missing. Throws badInput for a table without a quantity or without rows.
SeenSignal readTrace(const std::filesystem::path& file, const ReadingOptions& options);

}  // namespace study::looking
