// The codebook of an export: what each column of its tables is, in which unit, and which values it can have.
#pragma once

#include <string>
#include <vector>

#include "protocols/protocol.h"

namespace study::exports {

/// Columns that a public export leaves out: what names a day, and what people said in their own words.
bool isPrivateColumn(const std::string& column);

/// codebook.csv for answers.csv and participants.csv: file, column, type, unit, values, meaning. `answerColumns`: those of the
/// export, in their order; each is known (asserted).
std::string codebookCsv(const protocols::Protocol& protocol, const std::vector<protocols::FabricId>& fabrics,
                        const std::vector<std::string>& answerColumns);

}  // namespace study::exports
