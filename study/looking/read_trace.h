// Reads friction records as traces for a sheet. It also accepts records that a data set refuses, because the sheet shows gaps.
#pragma once

#include "study/looking/read_signal.h"

namespace study::looking {

/// Reads CSV with t_s or position_mm (or neither) and with normal_n,tangential_n, or a coefficient such as mu or COF, or any
/// quantity. Cells that are not numbers, and friction at a normal force up to 0.05 N, are missing. Throws badInput for a table
/// without quantity or rows, and for times, places or values that no axis can show.
SeenSignal readTrace(const std::filesystem::path& file, const ReadingOptions& options);

}  // namespace study::looking
